// SPDX-License-Identifier: MIT
using System;
using NUnit.Framework;
using UnityEngine.TestTools;

[assembly: Knurl.Tests.Scopes]

namespace Knurl.Tests
{
    /// <summary>Imitates Unity's runner around each test's body: the logs before it (set-up and last tear-down) and of
    /// the body are separate scopes. See LogAssert.</summary>
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
