// SPDX-License-Identifier: MIT
using System.Linq;
using Knurl.Editing;
using Knurl.Tests;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;

namespace Knurl.Cases
{
    /// <summary>A new user's first steps: new objects, the mouse, a cursor, pictures, and
    /// the first build.</summary>
    [TestFixture]
    public sealed class FirstMinutes : Suite
    {
        [SetUp]
        public void SetUp()
        {
            AssetDatabase.Clear();
            Selection.objects = new Object[0];
            SceneView.lastActiveSceneView = new SceneView { pivot = new Vector3(1f, 2f, 3f) };
        }

        [TearDown]
        public void TearDown()
        {
            StageUtility.Open = null;
            SceneView.lastActiveSceneView = null;
            PlayerSettings.stripUnusedMeshComponents = false;
            Input.MouseButtons[0] = false;
            Input.mousePosition = Vector3.zero;
            Player.LeaveScene();
        }

        static GameObject NewDevice(GameObject context = null)
        {
            Hooks.CallMenu("GameObject/Knurl/Haptic Device", false, context);
            return Selection.activeGameObject;
        }

        [Test]
        public void A_new_object_is_where_the_scene_view_looks()
        {
            Assert.AreEqual(new Vector3(1f, 2f, 3f), NewDevice().transform.position);
            GameObject parent = MakeObject("Parent");
            parent.transform.position = Vector3.up;
            GameObject below = NewDevice(parent);
            Assert.AreSame(parent.transform, below.transform.parent);
            Assert.AreEqual(Vector3.up, below.transform.position);
        }

        [Test]
        public void A_new_object_is_in_the_prefab_that_is_open()
        {
            StageUtility.Open = MakeObject("Prefab");
            Assert.AreSame(StageUtility.Open.transform, NewDevice().transform.parent);
        }

        KnurlSurface MakeDrawn(Vector3 at)
        {
            KnurlSurface surface = MakeSurface(Plate());
            surface.gameObject.AddComponent<MeshRenderer>().bounds = new Bounds(at, 0.1f * Vector3.one);
            return surface;
        }

        [Test]
        public void A_new_devices_box_is_about_the_selected_surfaces()
        {
            KnurlSurface a = MakeDrawn(Vector3.zero), b = MakeDrawn(new Vector3(0.2f, 0f, 0.4f));
            Selection.objects = new Object[] { a.gameObject, b.gameObject, MakeObject("Other") };
            GameObject made = NewDevice(a.gameObject);
            Assert.IsNull(made.transform.parent);
            AreNear(new Vector3(0.1f, 0f, 0.2f), made.transform.position, 1e-6);
            Assert.AreSame(made, Selection.activeGameObject);
        }

        [Test]
        public void A_new_cursor_is_a_ball_that_nothing_collides_with()
        {
            Hooks.CallMenu("GameObject/Knurl/Haptic Cursor", false);
            GameObject made = Selection.activeGameObject;
            Assert.IsNotNull(made.GetComponent<KnurlCursor>());
            Assert.IsNotNull(made.GetComponent<MeshRenderer>());
            Assert.IsTrue(made.GetComponent<Collider>() == null);
        }

        /// <summary>The stand-in's camera looks straight ahead, one pixel per millimetre.</summary>
        [Test]
        public void The_mouse_presses_what_is_under_it_and_the_cursor_shows_where()
        {
            MakeObject("Camera").AddComponent<Camera>().transform.position = new Vector3(0f, 0f, -0.2f);
            KnurlSurface surface = MakeSmooth(Plate());
            surface.transform.rotation = Quaternion.Euler(-90f, 0f, 0f); // it faces the camera
            surface.transform.position = new Vector3(0f, 0f, 0.05f);
            KnurlDevice device = MakeDevice("mouse");
            KnurlMouse mouse = device.gameObject.AddComponent<KnurlMouse>();
            KnurlCursor proxy = MakeObject("Proxy").AddComponent<KnurlCursor>();
            KnurlCursor hip = MakeObject("HIP").AddComponent<KnurlCursor>();
            hip.ShowsHip = true;
            Assert.IsTrue(device.StartDevice());
            Input.mousePosition = new Vector3(20f, 10f, 0f);
            Assert.IsTrue(Player.Until(() => (device.HipPosition - new Vector3(0.02f, 0.01f, 0.05f - mouse.Hover))
                .magnitude < 1e-4f), "it hovers");
            Assert.IsFalse(device.InContact);
            Input.MouseButtons[0] = true;
            Assert.IsTrue(Player.Until(() => device.Touched == surface));
            Assert.IsTrue(Player.Until(() => (device.HipPosition - new Vector3(0.02f, 0.01f, 0.05f + mouse.Depth))
                .magnitude < 1e-5f), "it presses");
            Assert.IsTrue(Player.Until(() => (proxy.transform.position - new Vector3(0.02f, 0.01f, 0.05f)).magnitude
                < 1e-4f), "the proxy stays outside");
            Assert.Greater(hip.transform.position.z, proxy.transform.position.z + 0.0005f);
            Input.mousePosition = new Vector3(500f, 10f, 0f); // outside of all surfaces it continues in their plane
            Assert.IsTrue(Player.Until(() => device.HipPosition.x > 0.49f && !device.InContact));
        }

        [Test]
        public void A_mouse_makes_its_device_one()
        {
            Player.ExitPlayMode();
            KnurlDevice device = MakeDevice("fake");
            device.gameObject.AddComponent<KnurlMouse>();
            Player.EnterPlayMode();
            Assert.AreEqual("mouse", device.Device);
        }

        static int Rises(Color32[] pixels, int from, int step, int count)
        {
            return Enumerable.Range(1, count - 1).Count(i => pixels[from + (i - 1) * step].r < pixels[from + i * step].r);
        }

        /// <summary>10 mm wide: at 1000 ridges a metre there are ten.</summary>
        [Test]
        public void A_gratings_picture_has_its_ridges()
        {
            KnurlGrating grating = MakeGrating(1000f);
            Color32[] pixels = Thumbnail.Draw(grating, 128, 128);
            Assert.AreEqual(10, Rises(pixels, 0, 1, 128));
            Assert.AreEqual(0, Rises(pixels, 0, 128, 128));
            grating.Orientation = 0.5f * Mathf.PI;
            pixels = Thumbnail.Draw(grating, 128, 128);
            Assert.AreEqual(0, Rises(pixels, 0, 1, 128));
            Assert.AreEqual(10, Rises(pixels, 0, 128, 128));
            Texture2D picture = Hooks.EditorOf(grating).RenderStaticPreview("", null, 64, 32);
            Assert.AreEqual(64 * 32, picture.Pixels.Length);
        }
    }
}
