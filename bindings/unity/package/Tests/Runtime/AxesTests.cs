// SPDX-License-Identifier: MIT
using System.Reflection;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Conversion between Unity's left-handed axes and Knurl's right-handed ones, with cases that a mirror
    /// would change.
    /// </summary>
    [TestFixture]
    public class AxesTests : Suite
    {
        static readonly Vector3 Skew = new Vector3(20f, -35f, 50f);

        [Test]
        public void APlateIsFeltWhereItIsSeen()
        {
            KnurlSurface surface = MakeSmooth(Plate(0.02f));
            surface.transform.position = new Vector3(0.3f, 0.1f, -0.2f);
            AreNear(Wall(Vector3.up), Press(new Vector3(0.305f, 0.1f, -0.205f), Vector3.up), 1e-4);
            AreNear(Vector3.zero, Press(new Vector3(-0.3f, 0.1f, -0.2f), Vector3.up), 0.0, "mirrored in x");
            AreNear(Vector3.zero, Press(new Vector3(0.3f, 0.1f, 0.2f), Vector3.up), 0.0, "mirrored in z");
        }

        [TestCase(1f, 0f, 0f)]
        [TestCase(-1f, 0f, 0f)]
        [TestCase(0f, 1f, 0f)]
        [TestCase(0f, 0f, 1f)]
        [TestCase(0f, 0f, -1f)]
        [TestCase(1f, 2f, -3f)]
        public void ForcesPointOutOfTheSurface(float x, float y, float z)
        {
            Vector3 outwards = new Vector3(x, y, z).normalized;
            KnurlSurface surface = MakeSmooth(Plate());
            surface.transform.rotation = Quaternion.FromToRotation(Vector3.up, outwards);
            AreNear(Wall(outwards), Press(Vector3.zero, outwards), 1e-4);
            AreNear(Vector3.zero, Press(Vector3.zero, -outwards), 0.0, "from behind");
        }

        [Test]
        public void ThePlateIsFeltFromItsFrontOnly()
        {
            KnurlSurface surface = MakeSmooth(Plate());
            AreNear(Wall(Vector3.up), PressDown(0f, 0f), 1e-5);
            AreNear(Vector3.zero, Press(Vector3.zero, Vector3.down), 0.0, "from behind");
            surface.DoubleSided = true;
            AreNear(Wall(Vector3.down), Press(Vector3.zero, Vector3.down), 1e-5, "double sided");
        }

        // Rotation, scale, parent's rotation, parent's scale; all of a plate of 100 x 60 mm.
        [TestCase(0f, 0f, 0f, 1f, 1f, 1f, 0f, 0f, 0f, 1f, 1f, 1f)]
        [TestCase(20f, -35f, 50f, 1f, 1f, 1f, 0f, 0f, 0f, 1f, 1f, 1f)]
        [TestCase(0f, 0f, 0f, 1.5f, 3f, 0.7f, 0f, 0f, 0f, 1f, 1f, 1f)]
        [TestCase(20f, -35f, 50f, 1.5f, 3f, 0.7f, 0f, 0f, 0f, 1f, 1f, 1f)]
        [TestCase(0f, 0f, 0f, -1f, 1f, 1f, 0f, 0f, 0f, 1f, 1f, 1f)]
        [TestCase(20f, -35f, 50f, 1f, 1f, -1f, 0f, 0f, 0f, 1f, 1f, 1f)]
        [TestCase(20f, -35f, 50f, 1.2f, -0.8f, 1f, 0f, 0f, 0f, 1f, 1f, 1f)]
        [TestCase(20f, -35f, 50f, -1.2f, -0.8f, -2f, 0f, 0f, 0f, 1f, 1f, 1f)]
        [TestCase(0f, 40f, 0f, 1f, 1f, 1f, 0f, 0f, 0f, 2f, 1f, 0.8f)]
        [TestCase(20f, -35f, 50f, 1.2f, 0.8f, 1f, -15f, 70f, 25f, 1.5f, 0.9f, 0.7f)]
        [TestCase(20f, -35f, 50f, 1.2f, 0.8f, 1f, -15f, 70f, 25f, -1.5f, 0.9f, 0.7f)]
        public void APlateIsFeltAsItStands(float rx, float ry, float rz, float sx, float sy, float sz,
            float prx, float pry, float prz, float psx, float psy, float psz)
        {
            Mesh mesh = Plate(0.1f);
            Vector3[] corners = mesh.vertices;
            for (int i = 0; i < 4; i++)
            {
                corners[i].z *= 0.6f;
            }
            mesh.vertices = corners;
            KnurlSurface surface = MakeSmooth(mesh);
            Transform parent = MakeObject("Parent").transform;
            parent.localPosition = new Vector3(0.02f, -0.03f, 0.05f);
            parent.localRotation = Quaternion.Euler(prx, pry, prz);
            parent.localScale = new Vector3(psx, psy, psz);
            Transform own = surface.transform;
            own.SetParent(parent, false);
            own.localPosition = new Vector3(-0.01f, 0.015f, 0.03f);
            own.localRotation = Quaternion.Euler(rx, ry, rz);
            own.localScale = new Vector3(sx, sy, sz);

            Matrix4x4 m = own.localToWorldMatrix;
            Vector3 up = m.inverse.transpose.MultiplyVector(Vector3.up).normalized;
            AreNear(Wall(up), Press(m.MultiplyPoint3x4(new Vector3(0.04f, 0f, 0.02f)), up), 2e-4, "inside");
            AreNear(Wall(up), Press(m.MultiplyPoint3x4(new Vector3(-0.045f, 0f, 0.025f)), up), 2e-4,
                "inside, a corner");
            AreNear(Vector3.zero, Press(m.MultiplyPoint3x4(new Vector3(0.06f, 0f, 0f)), up), 0.0, "beyond x");
            AreNear(Vector3.zero, Press(m.MultiplyPoint3x4(new Vector3(0f, 0f, -0.036f)), up), 0.0, "beyond z");
            AreNear(Vector3.zero, Press(m.MultiplyPoint3x4(Vector3.zero), -up), 0.0, "from behind");
        }

        [Test]
        public void AGratingAcrossXOnlyIsCrossedAlongX()
        {
            KnurlSurface surface = MakeSurface(Plate());
            Assert.That(Ridges(surface, Vector3.zero, Vector3.right), Is.GreaterThan(28).And.LessThan(35));
            Assert.AreEqual(0, Ridges(surface, Vector3.zero, Vector3.forward));
        }

        static Vector3 Across(Vector3 along)
        {
            return new Vector3(-along.z, 0f, along.x);
        }

        /// <summary>A plate with these tangents, and with u along a direction or without UVs.</summary>
        KnurlSurface MakeTurned(Vector3 along, bool hasUvs, Vector3 tangent)
        {
            Mesh mesh = Plate();
            var tangents = new Vector4[4];
            var uvs = new Vector2[4];
            for (int i = 0; i < 4; i++)
            {
                Vector3 p = mesh.vertices[i];
                tangents[i] = new Vector4(tangent.x, tangent.y, tangent.z, -1f);
                uvs[i] = hasUvs ? 10f * new Vector2(Vector3.Dot(p, along), Vector3.Dot(p, Across(along))) : Vector2.zero;
            }
            mesh.uv = uvs;
            mesh.tangents = tangents;
            return MakeSurface(mesh);
        }

        // 1 mm ridges by S2, which depends on velocity only.
        void RunsAlong(KnurlSurface surface, Vector3 along)
        {
            Assert.AreEqual(1000.0 * 0.04, Frequency(surface, along), 4.0);
            Assert.AreEqual(0.0, Frequency(surface, Across(along)), 1.0);
        }

        [Test]
        public void RidgesFollowUvs()
        {
            Vector3 along = new Vector3(1f, 0f, 2f).normalized;
            KnurlSurface surface = MakeTurned(along, true, along);
            Assert.That(Ridges(surface, Vector3.zero, along), Is.GreaterThan(28).And.LessThan(35));
            Assert.AreEqual(0, Ridges(surface, Vector3.zero, Across(along)));
            RunsAlong(surface, along);
        }

        /// <summary>glTFast turns positions into Unity's axes by -x and tangents by -z: on diagonals such tangents are
        /// wrong by 90 degrees; here a wall in the file's xy plane.</summary>
        [Test]
        public void RidgesFollowUvsWhateverAnImporterMadeOfTangents()
        {
            Vector3 inFile = new Vector3(1f, 1f, 0f).normalized;
            Vector3 along = new Vector3(-inFile.x, 0f, inFile.y); // the wall lies flat: its y is this plate's z
            Vector3 tangent = new Vector3(inFile.x, 0f, inFile.y);
            RunsAlong(MakeTurned(along, true, tangent), along);
        }

        [TestCase(true)]
        [TestCase(false)] // UVs exist, but are all equal
        public void WithoutUvsRidgesFollowTangents(bool areNone)
        {
            Vector3 along = new Vector3(1f, 0f, 2f).normalized;
            KnurlSurface surface = MakeTurned(along, false, along);
            if (areNone)
            {
                surface.GetComponent<MeshFilter>().sharedMesh.uv = null;
            }
            RunsAlong(surface, along);
        }

        // Temporal frequency at 40 mm/s along `direction` (Hz).
        double Frequency(KnurlSurface surface, Vector3 direction)
        {
            surface.Grating.Method = GratingMethod.S2;
            KnurlDevice device = MakeDevice();
            device.Clamp = false;
            var rows = new double[8];
            for (int i = 0; i < 3; i++)
            {
                rows[1 + i] = -0.02 * direction[i] - (i == 1 ? Depth : 0.0);
                rows[5 + i] = 0.02 * direction[i] - (i == 1 ? Depth : 0.0);
            }
            rows[4] = 1.0;
            double[] forces = device.PlayTrace(rows, 1000);
            Object.DestroyImmediate(device.gameObject);
            int rises = 0;
            for (int i = 200; i < 999; i++)
            {
                rises += forces[3 * i + 1] < 0.4 && forces[3 * i + 4] >= 0.4 ? 1 : 0;
            }
            return rises / 0.8;
        }

        [Test]
        public void UvsCountFromWhereFilesCountThem()
        {
            // v is 0 at the bottom in Unity and at the top in glTF: a crest at v = 1; 7.5 ridges on, at v = 0, a
            // groove.
            KnurlSurface surface = MakeSurface(Plate(0.1f));
            surface.Grating.SpatialFrequency = new Vector2(0f, 75f);
            surface.Grating.Method = GratingMethod.S1;
            AreNear(new Vector3(0f, 0.48f, 0f), PressDown(0f, 0.0495f), 1e-4, "at v = 0.995");
            AreNear(new Vector3(0f, 0.32f, 0f), PressDown(0f, -0.0495f), 1e-4, "at v = 0.005");
        }

        [Test]
        public void AnAxisIsTheMeshesOwn()
        {
            KnurlSurface surface = MakeSurface(Plate());
            surface.Axis = new Vector3(1f, 0f, 2f);
            Vector3 turned = Quaternion.Euler(0f, 90f, 0f) * new Vector3(1f, 0f, 2f);
            Assert.That(Ridges(surface, Vector3.zero, new Vector3(1f, 0f, 2f)), Is.GreaterThan(28).And.LessThan(35));
            Assert.AreEqual(0, Ridges(surface, Vector3.zero, new Vector3(-2f, 0f, 1f)));
            surface.transform.rotation = Quaternion.Euler(0f, 90f, 0f);
            Assert.That(Ridges(surface, Vector3.zero, turned), Is.GreaterThan(28).And.LessThan(35));
            Assert.AreEqual(0, Ridges(surface, Vector3.zero, new Vector3(-turned.z, 0f, turned.x)));
        }

        [Test]
        public void OrientationTurnsCounterClockwiseAsSeenFromTheFront()
        {
            KnurlSurface surface = MakeSurface(Plate());
            surface.Grating.Orientation = Mathf.PI / 6f;
            // From above, x to the right, z is up on the page: counter-clockwise leads from x to z.
            Vector3 along = new Vector3(Mathf.Cos(Mathf.PI / 6f), 0f, Mathf.Sin(Mathf.PI / 6f));
            Assert.That(Ridges(surface, Vector3.zero, along), Is.GreaterThan(28).And.LessThan(35));
            Assert.AreEqual(0, Ridges(surface, Vector3.zero, new Vector3(-along.z, 0f, along.x)));
        }

        [Test]
        public unsafe void ADevicesFrameIsItsObjects()
        {
            KnurlDevice device = MakeDevice();
            device.transform.position = new Vector3(0.3f, -0.1f, 0.2f);
            device.transform.rotation = Quaternion.Euler(Skew);
            device.WorkspaceScale = 2f;
            Assert.That(device.StartDevice());
            knurl_workspace workspace;
            SessionHandle session = SessionOf(device);
            Assert.AreEqual(0, NativeMethods.knurl_scene_get_workspace(NativeMethods.knurl_session_get_scene(session), 0,
                &workspace));
            Assert.AreEqual(0, NativeMethods.knurl_workspace_check(&workspace));
            Transform t = device.transform;
            AreNear(t.position, ToUnity(&workspace, 0, 0, 0), 1e-6, "the origin");
            AreNear(t.position + 0.2f * t.right, ToUnity(&workspace, 0.1, 0, 0), 1e-6, "to the right");
            AreNear(t.position + 0.2f * t.up, ToUnity(&workspace, 0, 0.1, 0), 1e-6, "up");
            AreNear(t.position - 0.2f * t.forward, ToUnity(&workspace, 0, 0, 0.1), 1e-6, "towards the user");
            device.StopDevice();
        }

        /// <summary>A stylus with the device's axes points along the z of the device's object.</summary>
        [Test]
        public unsafe void AStylusThatIsNotTurnedStandsAsItsDevicesObject()
        {
            knurl_workspace workspace;
            knurl_session_pose pose;
            double* rows = stackalloc double[12];
            Quaternion turned = Quaternion.Euler(Skew);
            Axes.ToWorkspace(Vector3.zero, turned, 1.0, &workspace);
            for (int i = 0; i < 12; i++)
            {
                rows[i] = i % 4 == 3 ? 0.0 : workspace.rotation[3 * (i / 4) + i % 4];
            }
            Assert.AreEqual(1, NativeMethods.knurl_session_split_pose(rows, &pose));
            Quaternion found = Axes.ToRotation(pose.quaternion);
            AreNear(turned * Vector3.forward, found * Vector3.forward, 1e-6, "forward");
            AreNear(turned * Vector3.up, found * Vector3.up, 1e-6, "up");
            for (int i = 0; i < 4; i++)
            {
                pose.quaternion[i] = 0.0;
            }
            Assert.AreEqual(Quaternion.identity, Axes.ToRotation(pose.quaternion));
        }

        static unsafe Vector3 ToUnity(knurl_workspace* workspace, double right, double up, double towards)
        {
            double* from = stackalloc double[3];
            double* to = stackalloc double[3];
            from[0] = right;
            from[1] = up;
            from[2] = towards;
            NativeMethods.knurl_workspace_to_scene(workspace, from, to);
            return new Vector3((float)-to[0], (float)to[1], (float)to[2]);
        }

        static SessionHandle SessionOf(KnurlDevice device)
        {
            foreach (FieldInfo field in typeof(KnurlDevice).GetFields(BindingFlags.Instance | BindingFlags.NonPublic))
            {
                if (field.FieldType == typeof(SessionHandle))
                {
                    return (SessionHandle)field.GetValue(device);
                }
            }
            Assert.Fail("KnurlDevice has no SessionHandle");
            return null;
        }

        [Test]
        public void AParentsScaleDoesNotScaleTheDevicesWorkspace()
        {
            // A finger at the object's origin touches a plate that stands there, whatever the scale.
            KnurlDevice device = MakeDevice();
            Transform parent = MakeObject("Parent").transform;
            parent.localScale = new Vector3(3f, 3f, 3f);
            device.transform.SetParent(parent, false);
            device.transform.localPosition = new Vector3(0.1f, 0f, 0f);
            MakeSmooth(Plate(0.02f)).transform.position = new Vector3(0.3f, 0f, 0f);
            double[] forces = device.PlayTrace(new[] { 0.0, 0.3, 0.01, 0.0, 0.2, 0.3, -Depth, 0.0 }, 400);
            Assert.AreEqual(Stiffness * Depth, forces[1198], 1e-5);
        }
    }
}
