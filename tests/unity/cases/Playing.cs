// SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>A game in a domain of its own, as an editor's scripts are. It lives in no test class, so that NUnit is
    /// not loaded there.</summary>
    public sealed class Playing : MarshalByRefObject
    {
        KnurlDevice device;

        /// <summary>Plays a scene until its device feels something; false if that takes too long.</summary>
        public bool Play()
        {
            Player.EnterPlayMode();
            var mesh = new Mesh();
            mesh.vertices = new[]
            {
                new Vector3(-1, 0, -1), new Vector3(-1, 0, 1), new Vector3(1, 0, 1), new Vector3(1, 0, -1)
            };
            mesh.uv = new[] { new Vector2(0, 0), new Vector2(0, 1), new Vector2(1, 1), new Vector2(1, 0) };
            mesh.triangles = new[] { 0, 1, 2, 0, 2, 3 };
            var plate = new GameObject("Plate");
            plate.AddComponent<MeshFilter>().sharedMesh = mesh;
            plate.AddComponent<KnurlSurface>().Grating = ScriptableObject.CreateInstance<KnurlGrating>();
            device = new GameObject("Device").AddComponent<KnurlDevice>();
            device.Stroke = "rest";
            return Player.Until(() => device.Running && device.Touched != null);
        }

        public long Ticks
        {
            get { return device.Ticks; }
        }

        /// <summary>An editor's actions before it unloads the domain.</summary>
        public void BeforeReload()
        {
            Player.ReloadAssemblies();
        }
    }
}
