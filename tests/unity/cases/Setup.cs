// SPDX-License-Identifier: MIT
using System.IO;
using System.Reflection;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Imitates Unity before the package's own tests: its editor loads the package, and the tests run in play
    /// mode.</summary>
    [SetUpFixture]
    public class Setup
    {
        [SetUp]
        public void EnterPlayMode()
        {
            Load(typeof(KnurlDevice).Assembly.Location);
            Load(Path.Combine(Repository.Folder, "Knurl.Haptics.Editor.dll"));
            Player.EnterPlayMode();
        }

        static void Load(string path)
        {
            if (File.Exists(path))
            {
                EditorApplication.Load(Assembly.LoadFrom(path));
            }
        }
    }
}
