// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Knurl.Tests
{
    /// <summary>Each event times each action of its handler: no exception, no error, no thread left, and another device
    /// continues.</summary>
    [TestFixture]
    public class HandlerDeedTests : PlayerSuite
    {
        KnurlDevice device, other;
        KnurlSurface surface;

        /// <summary>Events, and the device that brings them about.</summary>
        static readonly Dictionary<string, string> Uris = new Dictionary<string, string>
        {
            { "touched", "mouse" }, { "contactStarted", "mouse" }, { "ridgesPassed", "fake" },
            { "buttonChanged", "fake:?press_at=0.05" }, { "fault", "fake:?lose_at=0.05" }, { "startFailed", "nonsense" },
            { "released", "mouse" }, { "contactEnded", "mouse" }
        };

        static readonly string[] Ends = { "disable surface", "stop", "disable device", "destroy device", "destroy plate" };

        static readonly string[] Deeds =
        {
            "destroy device", "destroy device later", "deactivate device", "destroy plate", "deactivate plate",
            "destroy other", "leave the scene", "start again"
        };

        static IEnumerable<TestCaseData> Cells()
        {
            foreach (string deed in Deeds)
            {
                foreach (string what in Uris.Keys)
                {
                    bool ends = what == "released" || what == "contactEnded";
                    foreach (string end in ends ? Ends : new[] { "" })
                    {
                        yield return new TestCaseData(what, end, deed).SetName(what + (ends ? " by " + end : "") + ": " + deed);
                    }
                }
            }
        }

        [TestCaseSource("Cells")]
        public void AHandlerMayDoAnything(string what, string end, string deed)
        {
            int before = Threads();
            int calls = 0;
            Action handler = () =>
            {
                if (++calls == 1)
                {
                    Do(deed);
                }
            };
            Build(Uris[what]);
            if (end == "")
            {
                Listen(what, handler);
            }
            if (what == "startFailed")
            {
                ExpectError("found 'nonsense'");
                device.Autostart = true;
            }
            else
            {
                Assert.That(device.StartDevice());
            }
            Press();
            if (end != "")
            {
                Until(() => device.Touched != null && other.Touched != null, "both touch");
                Listen(what, handler);
                if (deed == end && deed.StartsWith("destroy", StringComparison.Ordinal))
                {
                    ExpectError("Destroying object multiple times"); // Unity's own rule
                }
                Do(end);
            }
            Until(() => calls > 0, what + " is told");
            Player.Frames(3);
            if (other != null)
            {
                long ticks = other.Ticks;
                Until(() => other.Ticks > ticks, "the other device goes on");
            }
            Player.LeaveScene();
            NoMoreThreadsThan(before);
        }

        void Build(string uri)
        {
            surface = MakeSurface(Plate());
            device = MakeDevice(uri, "line");
            other = MakeDevice("mouse");
            Assert.That(other.StartDevice());
        }

        /// <summary>Moves both fingers, if they are mice, from above onto the plate.</summary>
        void Press()
        {
            Point(0.001f);
            Until(() => !IsMouse(device) || device.Ticks > 5, "the device ticks");
            Until(() => !IsMouse(other) || other.Ticks > 5, "the other ticks");
            Point(-0.001f);
        }

        static bool IsMouse(KnurlDevice d)
        {
            return d != null && d.Running && d.Device == "mouse";
        }

        void Point(float height)
        {
            foreach (KnurlDevice d in new[] { device, other })
            {
                if (IsMouse(d))
                {
                    d.MoveHip(new Vector3(0f, height, 0f));
                }
            }
        }

        void Listen(string what, Action handler)
        {
            switch (what)
            {
                case "touched": surface.touched.AddListener(d => handler()); break;
                case "released": surface.released.AddListener(d => handler()); break;
                case "ridgesPassed": surface.ridgesPassed.AddListener((d, n) => handler()); break;
                case "contactStarted": device.contactStarted.AddListener(s => handler()); break;
                case "contactEnded": device.contactEnded.AddListener(s => handler()); break;
                case "buttonChanged": device.buttonChanged.AddListener((i, on) => handler()); break;
                case "fault": device.fault.AddListener((code, text) => handler()); break;
                default: device.startFailed.AddListener((code, text) => handler()); break;
            }
        }

        void Do(string deed)
        {
            MonoBehaviour part = surface;
            if (deed.Contains("device") || deed.Contains("other"))
            {
                part = deed.Contains("device") ? device : other;
            }
            if (deed == "leave the scene")
            {
                Player.LeaveScene();
            }
            else if (deed == "stop" || deed == "start again")
            {
                StopOrStart(deed != "stop");
            }
            else if (part == null)
            {
                return; // gone already
            }
            else if (deed.StartsWith("disable", StringComparison.Ordinal))
            {
                part.enabled = false;
            }
            else if (deed.StartsWith("deactivate", StringComparison.Ordinal))
            {
                part.gameObject.SetActive(false);
            }
            else if (deed.EndsWith("later", StringComparison.Ordinal))
            {
                Object.Destroy(part.gameObject);
            }
            else
            {
                Object.DestroyImmediate(part.gameObject);
            }
        }

        void StopOrStart(bool again)
        {
            if (device != null)
            {
                device.StopDevice();
                if (again && device.isActiveAndEnabled && device.Device != "nonsense")
                {
                    device.StartDevice();
                }
            }
        }
    }
}
