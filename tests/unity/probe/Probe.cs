// A game's view of a native library that may be missing or of another version. SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl.Tests
{
    internal static class Probe
    {
        static int Main(string[] arguments)
        {
            if (arguments.Length > 0)
            {
                Application.isEditor = false;
                PlayAGame();
            }
            else
            {
                CallEverything();
            }
            foreach (LogLine line in Debug.Lines)
            {
                Console.WriteLine("log: " + line);
            }
            Console.WriteLine("end");
            return 0;
        }

        /// A built game whose components start by themselves.
        static void PlayAGame()
        {
            Player.EnterPlayMode();
            for (int i = 0; i < 2; i++)
            {
                var owner = new GameObject("Device");
                KnurlDevice device = owner.AddComponent<KnurlDevice>();
                device.Retry = 0.001f;
                device.Sound = true;
                device.startFailed.AddListener((code, text) => Console.WriteLine("told: " + text));
                owner.AddComponent<KnurlMouse>();
                owner.AddComponent<KnurlCursor>();
                owner.AddComponent<KnurlRumble>();
                owner.AddComponent<KnurlEffect>();
                var plate = new GameObject("Surface");
                plate.AddComponent<MeshFilter>().sharedMesh = new Mesh();
                plate.AddComponent<KnurlSurface>().Grating = ScriptableObject.CreateInstance<KnurlGrating>();
            }
            Player.Frames(20);
            Player.ExitPlayMode();
        }

        static void CallEverything()
        {
            Player.EnterPlayMode();
            KnurlDevice device = new GameObject("Device").AddComponent<KnurlDevice>();
            device.Autostart = false;
            Console.WriteLine("started: " + device.StartDevice());
            Console.WriteLine("again: " + device.StartDevice());
            Console.WriteLine("file: " + device.LoadGltf("nothing.glb"));
            Console.WriteLine("trace: " + (device.PlayTrace(new double[8], 10) == null ? "none" : "some"));
            Console.WriteLine("running: " + device.Running + " " + device.Force + " " + device.GetStatus().Ticks);
            device.MoveHip(Vector3.zero);
            device.Autostart = true;
            KnurlSurface surface = new GameObject("Surface").AddComponent<KnurlSurface>();
            surface.Grating = ScriptableObject.CreateInstance<KnurlGrating>();
            Console.WriteLine("triangles: " + surface.TriangleCount);
            foreach (string warning in surface.GetWarnings())
            {
                Console.WriteLine("warning: " + warning);
            }
            Player.Frames(5);
            try
            {
                KnurlTags.Read("nothing.glb");
            }
            catch (KnurlException e)
            {
                Console.WriteLine("tags: " + e.Message);
            }
            Player.ExitPlayMode();
        }
    }
}
