// SPDX-License-Identifier: MIT
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>What Unity's runner does for the package's own tests: they find themselves in play mode.</summary>
    [SetUpFixture]
    public class Setup
    {
        [SetUp]
        public void EnterPlayMode()
        {
            Player.EnterPlayMode();
        }
    }
}
