// SPDX-License-Identifier: MIT
using System;
using System.Diagnostics;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>An object that turns below an unevenly scaled one: its shape changes in each frame.</summary>
    [TestFixture]
    public class ShearTests : PlayerSuite
    {
        const int Frames = 200;
        const float Tall = 0.02f; // m: above the sheet's waves

        KnurlSurface surface;
        KnurlDevice device;

        void Make(Mesh mesh)
        {
            device = StartResting();
            surface = MakeSurface(mesh);
            Transform parent = MakeObject("Parent").transform;
            parent.localScale = new Vector3(1f, 1f, 2f);
            surface.transform.SetParent(parent, false);
            Player.Frames(1);
        }

        void Turn(float radians)
        {
            surface.transform.localRotation = new Quaternion(0f, Mathf.Sin(0.5f * radians), 0f, Mathf.Cos(0.5f * radians));
        }

        /// <summary>Was each frame, for 1 ms and more.</summary>
        [Test]
        public void ReadingItTakesASmallPartOfTheTime()
        {
            Mesh mesh = Made(SharedTests.Sheet(70, 0.001f));
            Make(mesh);
            int before = mesh.Reads, slow = 0;
            var whole = Stopwatch.StartNew();
            var frame = new Stopwatch();
            for (int i = 0; i < Frames; i++)
            {
                Turn(0.01f * i);
                frame.Reset();
                frame.Start();
                Player.Frame();
                slow += frame.Elapsed.TotalMilliseconds > 1.0 ? 1 : 0;
                System.Threading.Thread.Sleep(5);
            }
            int reads = mesh.Reads - before;
            Console.WriteLine("note: 9800 triangles turn below an uneven scale: read {0} times in {1} frames, {2:f1} s; "
                + "{3} frames over 1 ms", reads, Frames, whole.Elapsed.TotalSeconds, slow);
            Assert.That(reads, Is.GreaterThan(0).And.LessThan(Frames / 4));
        }

        /// <summary>The plate is 0.1 m wide and, in the parent's z, 0.2 m long.</summary>
        [Test]
        public void ItsLastShapeIsFeltOnceItRests()
        {
            Make(SharedTests.Sheet(20, 0.0005f));
            for (int i = 0; i <= 20; i++)
            {
                Turn(0.05f * Mathf.PI * 0.5f * i); // a quarter in the end: its u runs along the parent's z
                Player.Frame();
            }
            KnurlRayHit hit;
            Vector3 above = new Vector3(0f, Tall, 0.09f), below = new Vector3(0f, -Tall, 0.09f);
            Until(() => device.CastRay(above, below, out hit), "it reaches 0.1 m along z");
            Assert.IsFalse(device.CastRay(above + new Vector3(0.06f, 0f, 0f), below + new Vector3(0.06f, 0f, 0f), out hit));
            Assert.That(surface.TriangleCount, Is.EqualTo(800));
        }
    }
}
