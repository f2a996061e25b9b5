// SPDX-License-Identifier: MIT
using System.Reflection;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

[assembly: Knurl.Tests.Scopes]

namespace Knurl.Cases
{
    /// <summary>These cases play.</summary>
    [SetUpFixture]
    public class Setup
    {
        [SetUp]
        public void EnterPlayMode()
        {
            EditorApplication.Load(Assembly.Load("Knurl.Haptics.Editor"));
            Player.EnterPlayMode();
        }

        [TearDown]
        public void ExitPlayMode()
        {
            Player.ExitPlayMode();
        }
    }
}
