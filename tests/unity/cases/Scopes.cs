// SPDX-License-Identifier: MIT
using System;
using NUnit.Framework;
using UnityEngine.TestTools;

[assembly: Knurl.Tests.Scopes]

namespace Knurl.Tests
{
    /// <summary>What Unity's runner does around each test's body: the log of what came before, a set-up's and the last
    /// tear-down's, is its own, and so is the body's. See LogAssert.</summary>
    [AttributeUsage(AttributeTargets.Assembly)]
    public sealed class ScopesAttribute : Attribute, ITestAction
    {
        public ActionTargets Targets
        {
            get { return ActionTargets.Test | ActionTargets.Suite; }
        }

        public void BeforeTest(TestDetails test)
        {
            LogAssert.EndScope();
        }

        public void AfterTest(TestDetails test)
        {
            LogAssert.EndScope();
        }
    }
}
