// SPDX-License-Identifier: MIT
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Cases
{
    /// <summary>These cases play.</summary>
    [SetUpFixture]
    public class Setup
    {
        [SetUp]
        public void EnterPlayMode()
        {
            Player.EnterPlayMode();
        }

        [TearDown]
        public void ExitPlayMode()
        {
            Player.ExitPlayMode();
        }
    }
}
