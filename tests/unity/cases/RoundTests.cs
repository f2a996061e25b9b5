// SPDX-License-Identifier: MIT
using System;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Nothing is left behind: threads, handles and memory before and after 100 rounds of play mode.</summary>
    [TestFixture]
    public class RoundTests : PlayerSuite
    {
        void Round()
        {
            Player.EnterPlayMode();
            KnurlSurface surface = MakeSurface(Plate());
            KnurlDevice device = MakeDevice("fake", "line");
            device.LoadGltf(Repository.Asset("plate_1d.glb"));
            Assert.That(device.StartDevice());
            Player.Frame();
            surface.GetWarnings();
            device.GetHistory(new float[200]);
            device.GetStatus();
            KnurlTags.Read(Repository.Asset("grid_2d.glb"));
            Player.ExitPlayMode();
            ClearAway();
        }

        static long Managed()
        {
            GC.Collect();
            GC.WaitForPendingFinalizers();
            return GC.GetTotalMemory(true) / 1024;
        }

        [Test]
        public void AHundredRoundsLeaveNothing()
        {
            Player.ExitPlayMode();
            for (int i = 0; i < 10; i++) // for one-time allocations
            {
                Round();
            }
            int threads = Threads(), handles = Handles();
            long managed = Managed(), resident = ResidentKib();
            Assert.That(threads > 0 && handles > 2 && resident > 1000, "there is something to count");
            for (int i = 0; i < 100; i++)
            {
                Round();
            }
            NoMoreThreadsThan(threads);
            Assert.That(Waits(() => Handles() <= handles), "expected " + handles + " handles, found " + Handles());
            long moreManaged = Managed() - managed, moreResident = ResidentKib() - resident;
            Console.WriteLine("note: 100 rounds of play mode: {0} KiB more managed, {1} KiB more resident", moreManaged,
                moreResident);
            Assert.That(moreManaged, Is.LessThan(256), "KiB of managed memory");
            Assert.That(moreResident, Is.LessThan(4096), "KiB of resident memory");
        }
    }
}
