// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>The same path through the package and through `knurl run`: see traces.py.</summary>
    [TestFixture]
    public class TraceTests : Suite
    {
        // The scene's axes are Unity's with x turned over; so a row has its x second, a force has it first.
        static double[] Mirrored(double[] values, int width, int x)
        {
            var mirrored = (double[])values.Clone();
            for (int i = x; i < mirrored.Length; i += width)
            {
                mirrored[i] = -mirrored[i];
            }
            return mirrored;
        }

        static double[] Rows(string asset)
        {
            return Mirrored(Repository.Doubles(asset + ".trace.bin"), 4, 1);
        }

        static double[] Expected(string asset)
        {
            double[] forces = Mirrored(Repository.Doubles(asset + ".forces.bin"), 3, 0);
            int felt = 0;
            foreach (double each in forces)
            {
                felt += Math.Abs(each) > 0.05 ? 1 : 0;
            }
            Assert.That(felt, Is.GreaterThan(1000), "there is something to compare with");
            return forces;
        }

        static double LargestDifference(double[] expected, double[] found, out int tick)
        {
            Assert.AreEqual(expected.Length, found.Length);
            double largest = 0.0;
            tick = -1;
            for (int i = 0; i < expected.Length; i++)
            {
                double difference = Math.Abs(expected[i] - found[i]);
                if (!(difference <= largest)) // also true for NaN
                {
                    largest = difference;
                    tick = i / 3;
                }
            }
            return largest;
        }

        // The tool puts the device's origin at the surfaces' centre, which a float cannot represent for the handle.
        [TestCase("plate_1d", 3, 0.0)]
        [TestCase("grid_2d", 1, 0.0)]
        [TestCase("knurled_handle", 1, 1e-12)]
        public void ThroughKnurlsLoaderTheBitsAreTheTools(string asset, int surfaces, double tolerance)
        {
            double[] expected = Expected(asset), rows = Rows(asset);
            KnurlDevice device = MakeDevice();
            device.Clamp = false; // as the tool plays it
            Assert.AreEqual(surfaces, device.LoadGltf(Repository.Asset(asset + ".glb")));
            for (int round = 0; round < 2; round++)
            {
                int tick;
                double difference = LargestDifference(expected, device.PlayTrace(rows, expected.Length / 3), out tick);
                Assert.That(difference, Is.LessThanOrEqualTo(tolerance), "round " + round + ", tick " + tick);
            }
        }

        // As glTFast and UnityGLTF build meshes; in an order of vertices and triangles of its own.
        Mesh Import(Glb file, Dictionary<string, object> primitive)
        {
            Dictionary<string, object> attributes = Glb.Object(primitive["attributes"]);
            float[] positions = file.Floats(Convert.ToInt32(attributes["POSITION"]), 3);
            float[] normals = file.Floats(Convert.ToInt32(attributes["NORMAL"]), 3);
            float[] uvs = file.Floats(Convert.ToInt32(attributes["TEXCOORD_0"]), 2);
            int[] indices = file.Indices(Convert.ToInt32(primitive["indices"]));
            int count = positions.Length / 3;
            var points = new Vector3[count];
            var directions = new Vector3[count];
            var coordinates = new Vector2[count];
            int[] order = Shuffled(count, 1);
            for (int i = 0; i < count; i++)
            {
                points[order[i]] = new Vector3(-positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
                directions[order[i]] = new Vector3(-normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
                coordinates[order[i]] = new Vector2(uvs[2 * i], 1f - uvs[2 * i + 1]);
            }
            int[] sequence = Shuffled(indices.Length / 3, 2);
            var triangles = new int[indices.Length];
            for (int i = 0; i < sequence.Length; i++)
            {
                triangles[3 * sequence[i]] = order[indices[3 * i]];
                triangles[3 * sequence[i] + 1] = order[indices[3 * i + 2]];
                triangles[3 * sequence[i] + 2] = order[indices[3 * i + 1]];
            }
            Mesh mesh = Made(new Mesh());
            mesh.vertices = points;
            mesh.normals = directions;
            mesh.uv = coordinates;
            mesh.triangles = triangles;
            return mesh;
        }

        static int[] Shuffled(int count, int seed)
        {
            var order = new int[count];
            var random = new System.Random(seed);
            for (int i = 0; i < count; i++)
            {
                int other = random.Next(i + 1);
                order[i] = order[other];
                order[other] = i;
            }
            return order;
        }

        [TestCase("plate_1d", 3)]
        [TestCase("grid_2d", 1)]
        [TestCase("knurled_handle", 1)]
        public void ThroughUnitysMeshesForcesAreWithinATenthOfAMillinewton(string asset, int surfaces)
        {
            double[] expected = Expected(asset);
            var file = new Glb(Repository.Asset(asset + ".glb"));
            int count = 0;
            foreach (Glb.Tagged tagged in file.Surfaces())
            {
                KnurlSurface surface = MakeSurface(Import(file, tagged.Primitive));
                surface.transform.position = new Vector3(-tagged.Translation.x, tagged.Translation.y,
                    tagged.Translation.z);
                surface.Grating.SpatialFrequency = Glb.Frequency(tagged.Tag);
                surface.Grating.Amplitude = (float)Glb.Value(tagged.Tag, "amplitude", 0.0);
                surface.Grating.Stiffness = (float)Glb.Value(tagged.Tag, "stiffness", 0.0);
                count++;
            }
            Assert.AreEqual(surfaces, count);
            KnurlDevice device = MakeDevice();
            device.Clamp = false;
            int tick;
            double difference = LargestDifference(expected, device.PlayTrace(Rows(asset), expected.Length / 3),
                out tick);
            Console.WriteLine("note: {0} from Unity's meshes: at most {1:g3} N off", asset, difference);
            Assert.That(difference, Is.LessThan(1e-4), "tick " + tick);
        }
    }
}
