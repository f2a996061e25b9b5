// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Base of all fixtures: clears scenes, presses walls. The runner fails a test that logs an unexpected
    /// error.</summary>
    public abstract class Suite
    {
        /// <summary>N/m: of every wall that a test makes, unless it says otherwise.</summary>
        protected const float Stiffness = 400f;

        /// <summary>m: depth of Press().</summary>
        protected const double Depth = 0.001;

        readonly List<Object> made = new List<Object>();

        [TearDown]
        public void ClearAway()
        {
            for (int i = made.Count - 1; i >= 0; i--)
            {
                if (made[i] != null)
                {
                    Object.DestroyImmediate(made[i]);
                }
            }
            made.Clear();
        }

        protected T Made<T>(T what) where T : Object
        {
            made.Add(what);
            return what;
        }

        protected GameObject MakeObject(string name)
        {
            return Made(new GameObject(name));
        }

        /// <summary>A square of `size` m in the xz plane whose front faces up, with u along x and v along z.</summary>
        protected Mesh Plate(float size = 0.1f)
        {
            float h = 0.5f * size;
            Mesh mesh = Made(new Mesh());
            mesh.name = "plate";
            mesh.vertices = new[]
            {
                new Vector3(-h, 0, -h), new Vector3(-h, 0, h), new Vector3(h, 0, h), new Vector3(h, 0, -h)
            };
            mesh.uv = new[] { new Vector2(0, 0), new Vector2(0, 1), new Vector2(1, 1), new Vector2(1, 0) };
            mesh.triangles = new[] { 0, 1, 2, 0, 2, 3 }; // clockwise, seen from above: Unity's front
            return mesh;
        }

        protected KnurlGrating MakeGrating(float frequency)
        {
            KnurlGrating grating = Made(ScriptableObject.CreateInstance<KnurlGrating>());
            grating.SpatialFrequency = new Vector2(frequency, 0f);
            grating.Amplitude = frequency > 0f ? 0.0002f : 0f;
            grating.Stiffness = Stiffness;
            return grating;
        }

        /// <summary>A surface of 1 mm ridges.</summary>
        protected KnurlSurface MakeSurface(Mesh mesh)
        {
            GameObject plate = MakeObject("Plate");
            plate.AddComponent<MeshFilter>().sharedMesh = mesh;
            KnurlSurface surface = plate.AddComponent<KnurlSurface>();
            surface.Grating = MakeGrating(1000f);
            return surface;
        }

        /// <summary>A smooth wall: F = K z.</summary>
        protected KnurlSurface MakeSmooth(Mesh mesh)
        {
            KnurlSurface surface = MakeSurface(mesh);
            surface.Grating = MakeGrating(0f);
            return surface;
        }

        /// <summary>A device that does not start by itself.</summary>
        protected KnurlDevice MakeDevice(string uri = "fake", string stroke = "")
        {
            KnurlDevice device = MakeObject("Device").AddComponent<KnurlDevice>();
            device.Autostart = false;
            device.Device = uri;
            device.Stroke = stroke;
            return device;
        }

        /// <summary>The force at rest 1 mm below `at`, after an approach from 10 mm above it along the unit vector `up`
        /// (N).
        /// </summary>
        protected Vector3 Press(Vector3 at, Vector3 up)
        {
            KnurlDevice device = MakeDevice();
            var rows = new double[8];
            for (int i = 0; i < 3; i++)
            {
                rows[1 + i] = at[i] + 0.01 * up[i];
                rows[5 + i] = at[i] - Depth * up[i];
            }
            rows[4] = 0.2;
            double[] forces = device.PlayTrace(rows, 400);
            Object.DestroyImmediate(device.gameObject);
            Assert.AreEqual(1200, forces.Length);
            return new Vector3((float)forces[1197], (float)forces[1198], (float)forces[1199]);
        }

        protected Vector3 PressDown(float x, float z)
        {
            return Press(new Vector3(x, 0f, z), Vector3.up);
        }

        protected static void AreNear(Vector3 expected, Vector3 found, double tolerance, string what = "")
        {
            Assert.That((double)(found - expected).magnitude, Is.LessThanOrEqualTo(tolerance),
                what + ": expected " + expected + ", found " + found);
        }

        protected static void Contains(string text, params string[] parts)
        {
            foreach (string part in parts)
            {
                Assert.That(text != null && text.Contains(part), "expected '" + part + "' in '" + text + "'");
            }
        }

        /// <summary>The force of the wall at Depth.</summary>
        protected static Vector3 Wall(Vector3 up)
        {
            return up * (float)(Stiffness * Depth);
        }

        /// <summary>Number of ridges crossed on 40 mm along `direction`, through `centre`, on a wall that faces up, by
        /// method S1, which depends on position only.</summary>
        protected int Ridges(KnurlSurface surface, Vector3 centre, Vector3 direction)
        {
            surface.Grating.Method = GratingMethod.S1;
            KnurlDevice device = MakeDevice();
            device.Clamp = false;
            Vector3 unit = direction.normalized;
            var rows = new double[8];
            for (int i = 0; i < 3; i++)
            {
                double below = i == 1 ? Depth : 0.0;
                rows[1 + i] = centre[i] - 0.02 * unit[i] - below;
                rows[5 + i] = centre[i] + 0.02 * unit[i] - below;
            }
            rows[4] = 1.0;
            double[] forces = device.PlayTrace(rows, 1000);
            Object.DestroyImmediate(device.gameObject);
            Assert.AreEqual(3000, forces.Length);
            int count = 0;
            double middle = Stiffness * Depth;
            for (int i = 200; i < 999; i++) // the first 0.2 s belong to the ramp at entry
            {
                count += forces[3 * i + 1] < middle && forces[3 * i + 4] >= middle ? 1 : 0;
            }
            return count;
        }
    }
}
