// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    /// <summary>For tests over several frames: the player sends a component's messages, like Unity. Tests poll for a
    /// state, with a timeout long enough for stalls of the machine.</summary>
    public abstract class PlayerSuite : Suite
    {
        [SetUp]
        public void EnterPlayMode()
        {
            Player.Clear();
            Player.EnterPlayMode();
        }

        [TearDown]
        public void LeaveEverything()
        {
            Player.Clear();
            Player.EnterPlayMode();
        }

        protected static void Until(Func<bool> what, string sentence)
        {
            Assert.That(Player.Until(what), sentence);
        }

        /// <summary>Without frames: for events while the game hangs.</summary>
        protected static bool Waits(Func<bool> what)
        {
            DateTime end = DateTime.UtcNow.AddSeconds(20.0);
            while (!what())
            {
                if (DateTime.UtcNow > end)
                {
                    return false;
                }
                System.Threading.Thread.Sleep(5);
            }
            return true;
        }

        protected static void ExpectError(string part)
        {
            LogAssert.Expect(LogType.Error, new Regex(Regex.Escape(part)));
        }

        protected static void ExpectException(string part)
        {
            LogAssert.Expect(LogType.Exception, new Regex(Regex.Escape(part)));
        }

        // Mono's own threads come and go as it likes; Knurl's have the name of the one that started them.
        static readonly string[] Others = { "Thread Pool", "Timer-Sched", "SGen worker", "Finalizer", "EventPump" };

        static List<string> ThreadNames()
        {
            var names = new List<string>();
            foreach (string task in Directory.GetDirectories("/proc/self/task"))
            {
                try
                {
                    string name = File.ReadAllText(task + "/comm").Trim();
                    if (!Others.Any(name.StartsWith))
                    {
                        names.Add(name);
                    }
                }
                catch (IOException)
                {
                    // It has just ended.
                }
            }
            return names;
        }

        protected static int Threads()
        {
            return ThreadNames().Count;
        }

        /// <summary>Ended threads are gone from the list a moment later.</summary>
        protected static void NoMoreThreadsThan(int before)
        {
            Assert.That(Waits(() => Threads() <= before),
                "expected " + before + " threads, found " + Words(ThreadNames()));
        }

        protected static int Handles()
        {
            return Directory.GetFiles("/proc/self/fd").Length;
        }

        protected static long ResidentKib()
        {
            foreach (string line in File.ReadAllLines("/proc/self/status"))
            {
                if (line.StartsWith("VmRSS:", StringComparison.Ordinal))
                {
                    return long.Parse(Regex.Match(line, "[0-9]+").Value);
                }
            }
            return 0;
        }

        /// <summary>A running device whose simulated hand rests 1 mm below the first surface.</summary>
        protected KnurlDevice StartResting()
        {
            KnurlDevice device = MakeDevice("fake", "rest");
            Assert.That(device.StartDevice());
            return device;
        }

        /// <summary>A running "mouse" whose HIP is at `at` already.</summary>
        protected KnurlDevice StartMouse(Vector3 at)
        {
            KnurlDevice device = MakeDevice("mouse");
            Assert.That(device.StartDevice());
            device.MoveHip(at);
            Until(() => device.Ticks > 50, "the mouse ticks");
            return device;
        }

        /// <summary>Down from 20 mm above a plate at the origin to 1 mm below it.</summary>
        protected KnurlDevice StartPressing()
        {
            KnurlDevice device = StartMouse(new Vector3(0f, 0.02f, 0f));
            device.MoveHip(new Vector3(0f, -0.001f, 0f));
            return device;
        }

        /// <summary>A wall that comes up around a finger is felt when the finger comes again.</summary>
        protected static void PressAgain(KnurlDevice device)
        {
            device.MoveHip(new Vector3(0f, 0.01f, 0f));
            Until(() => device.HipPosition.y > 0.005f, "up again");
            device.MoveHip(new Vector3(0f, -0.001f, 0f));
        }

        /// <summary>A device's events, in order, as words; without faults, which stalls of the machine may
        /// cause.</summary>
        protected static List<string> Listen(KnurlDevice device)
        {
            var told = new List<string>();
            device.contactStarted.AddListener(s => told.Add("started " + Name(s)));
            device.contactEnded.AddListener(s => told.Add("ended " + Name(s)));
            device.buttonChanged.AddListener((index, isPressed) => told.Add("button " + index + " " + isPressed));
            return told;
        }

        protected static List<string> ListenToFaults(KnurlDevice device)
        {
            var told = new List<string>();
            device.fault.AddListener((code, text) => told.Add(code + " " + text));
            return told;
        }

        static string Name(KnurlSurface surface)
        {
            return surface == null ? "null" : surface.name;
        }

        protected static string Words(List<string> told)
        {
            return string.Join(", ", told.ToArray());
        }
    }
}
