// SPDX-License-Identifier: MIT
using System;
using NUnit.Framework;

namespace Knurl.Tests
{
    /// <summary>Play mode with domain reload: the scripts' domain is unloaded while the haptic thread runs, and the
    /// native library stays.</summary>
    [TestFixture]
    public class DomainTests : PlayerSuite
    {
        static AppDomain Load(out Playing game)
        {
            var setup = new AppDomainSetup { ApplicationBase = Repository.Folder };
            AppDomain domain = AppDomain.CreateDomain("scripts", null, setup);
            game = (Playing)domain.CreateInstanceFromAndUnwrap(typeof(Playing).Assembly.Location,
                typeof(Playing).FullName);
            return domain;
        }

        [TestCase(true)]
        [TestCase(false)]
        public void ADomainThatIsUnloadedTakesItsThreadsAlong(bool isTold)
        {
            int before = Threads();
            for (int i = 0; i < 8; i++)
            {
                Playing game;
                AppDomain domain = Load(out game);
                Assert.That(game.Play(), "round " + i);
                Assert.That(Threads(), Is.GreaterThan(before), "there is something to count");
                if (isTold)
                {
                    game.BeforeReload();
                    NoMoreThreadsThan(before); // before the domain is unloaded
                }
                AppDomain.Unload(domain);
                NoMoreThreadsThan(before);
            }
            Assert.AreEqual(0u, NativeMethods.knurl_session_close_all(), "sessions that were left");
        }

        [Test]
        public void AnotherDomainsGameGoesOn()
        {
            Playing first, second;
            AppDomain one = Load(out first), other = Load(out second);
            Assert.That(first.Play() && second.Play());
            AppDomain.Unload(one);
            long then = second.Ticks;
            Assert.That(Waits(() => second.Ticks > then + 50), "ticks");
            AppDomain.Unload(other);
            Assert.AreEqual(0u, NativeMethods.knurl_session_close_all());
        }
    }
}
