// SPDX-License-Identifier: MIT
using System.Linq;
using Knurl.Tests;
using Knurl.Editing;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Knurl.Cases
{
    /// <summary>The drawing of inspectors and gizmos, recorded by the stand-ins.</summary>
    [TestFixture]
    public sealed class Drawing : Suite
    {
        [SetUp]
        public void SetUp()
        {
            EditorGUILayout.Drawn.Clear();
            EditorGUILayout.Answers.Clear();
            Gizmos.Drawn.Clear();
            GUI.Drawn.Clear();
            GenericMenu.Shown = null;
            GUI.Pressed.Clear();
            AssetDatabase.Clear();
            Selection.objects = new Object[0];
        }

        static void Draw(Object target)
        {
            Hooks.EditorOf(target).OnInspectorGUI();
        }

        static void AddPreset(string name, float stiffness)
        {
            var preset = ScriptableObject.CreateInstance<KnurlGrating>();
            preset.name = name;
            preset.Stiffness = stiffness;
            AssetDatabase.Assets["Packages/com.knurl.haptics/Presets/" + name + ".asset"] = preset;
        }

        [Test]
        public void A_grating_is_drawn_with_units_and_explained()
        {
            Draw(MakeGrating(1000f));
            foreach (string label in new[] { "spatialFrequency as Spatial Frequency (1/m)",
                "amplitude as Amplitude (m)", "stiffness as Stiffness (N/m)", "damping as Damping (N s/m)",
                "orientation as Orientation (degrees)" })
            {
                CollectionAssert.Contains(EditorGUILayout.Drawn, "property " + label);
            }
            CollectionAssert.Contains(EditorGUILayout.Drawn,
                "Info: A ridge every 1 mm along x, 0.4 mm from bottom to top.");
        }

        [Test]
        public void Layers_are_ticked_by_name_and_angles_edited_in_degrees()
        {
            KnurlSurface surface = MakeSurface(Plate());
            var layers = new SerializedObject(surface);
            EditorGUILayout.Answers["Layers"] = 5;
            new LayersDrawer().OnGUI(new Rect(), layers.FindProperty("layers"), new GUIContent("Layers"));
            layers.ApplyModifiedProperties();
            Assert.AreEqual(5, surface.Layers);
            CollectionAssert.Contains(EditorGUILayout.Drawn, "field Layers = 1");
            Assert.AreEqual(32, LayersDrawer.Names.Length);
            surface.Grating.Orientation = 0.25f * Mathf.PI;
            var grating = new SerializedObject(surface.Grating);
            EditorGUILayout.Answers.Clear();
            new DegreesDrawer().OnGUI(new Rect(), grating.FindProperty("orientation"), new GUIContent("Orientation"));
            CollectionAssert.Contains(EditorGUILayout.Drawn, "field Orientation = 45");
            Assert.AreEqual(0.25f * Mathf.PI, grating.FindProperty("orientation").floatValue, "only an edit changes it");
            EditorGUILayout.Answers["Orientation"] = 90f;
            new DegreesDrawer().OnGUI(new Rect(), grating.FindProperty("orientation"), new GUIContent("Orientation"));
            grating.ApplyModifiedProperties();
            Assert.AreEqual(0.5f * Mathf.PI, surface.Grating.Orientation, 1e-6f);
            EditorGUILayout.Answers.Clear();
        }

        [Test]
        public void A_grating_that_cannot_be_felt_says_why()
        {
            KnurlGrating grating = MakeGrating(1000f);
            grating.Stiffness = 0f;
            Draw(grating);
            CollectionAssert.Contains(EditorGUILayout.Drawn,
                "Error: Stiffness: expected more than 0. It cannot be felt.");
            grating.Stiffness = 400f;
            grating.SpatialFrequency = new Vector2(1f, -1f);
            Draw(grating);
            CollectionAssert.Contains(EditorGUILayout.Drawn,
                "Error: Spatial Frequency: expected 0 or more. It cannot be felt.");
            grating.SpatialFrequency = Vector2.zero;
            grating.Friction = float.NaN;
            Draw(grating);
            CollectionAssert.Contains(EditorGUILayout.Drawn,
                "Error: Amplitude, Damping, Friction: expected 0 or more. It cannot be felt.");
        }

        [Test]
        public void A_preset_gives_a_grating_its_numbers()
        {
            AddPreset("b", 150f);
            AddPreset("a", 250f);
            EditorGUILayout.Answers["Preset"] = true;
            KnurlGrating grating = MakeGrating(1000f);
            Draw(grating);
            Assert.AreEqual(new[] { "a", "b" },
                GenericMenu.Shown.Items.Keys.Take(2).Select(title => title.Split(':')[0]).ToArray());
            GenericMenu.Shown.Items.ElementAt(1).Value();
            Assert.AreEqual(150f, grating.Stiffness);
        }

        [Test]
        public void An_everyday_material_gives_a_grating_its_numbers_and_tells_its_sources()
        {
            EditorGUILayout.Answers["Preset"] = true;
            KnurlGrating grating = MakeGrating(1000f);
            Draw(grating);
            string[] titles = GenericMenu.Shown.Items.Keys.Where(title => title.StartsWith("Everyday materials/"))
                .ToArray();
            Assert.AreEqual(29, titles.Length);
            const string ruler = "Everyday materials/Engraved ruler: period 1 mm: its marks; depth 0.05 mm, a guess";
            GenericMenu.Shown.Items[ruler]();
            Assert.AreEqual(new Vector2(1000f, 0f), grating.SpatialFrequency);
            Assert.AreEqual(0.000025f, grating.Amplitude);
            Assert.AreEqual(800f, grating.Stiffness);
            Assert.AreEqual(0.2f, grating.Friction);
        }

        static KnurlGrating Preset(string name)
        {
            return AssetDatabase.LoadAssetAtPath<KnurlGrating>("Packages/com.knurl.haptics/Presets/" + name + ".asset");
        }

        /// <summary>The package's own cannot be edited, or would be changed for all projects.</summary>
        [Test]
        public void A_preset_gives_a_surface_a_copy_in_the_project()
        {
            AddPreset("a", 250f);
            EditorGUILayout.Answers["Preset"] = true;
            KnurlSurface surface = MakeSurface(Plate()), another = MakeSurface(Plate());
            foreach (KnurlSurface each in new[] { surface, another })
            {
                Draw(each);
                GenericMenu.Shown.Items.First().Value();
            }
            Assert.AreEqual("Assets/Gratings/a.asset", AssetDatabase.GetAssetPath(surface.Grating));
            Assert.AreEqual("Assets/Gratings/a 1.asset", AssetDatabase.GetAssetPath(another.Grating));
            Assert.AreEqual(250f, surface.Grating.Stiffness);
            surface.Grating.Stiffness = 100f;
            Assert.AreEqual(250f, another.Grating.Stiffness);
            Assert.AreEqual(250f, Preset("a").Stiffness);
        }

        [Test]
        public void A_surface_gets_a_new_grating_at_a_button()
        {
            KnurlSurface surface = MakeSurface(Plate());
            surface.Grating = null;
            GUI.Pressed.Add("New grating");
            Draw(surface);
            Assert.AreEqual("Assets/Gratings/Grating.asset", AssetDatabase.GetAssetPath(surface.Grating));
        }

        [Test]
        public void A_surface_that_has_the_packages_own_grating_gets_a_copy_at_a_button()
        {
            AddPreset("a", 250f);
            KnurlSurface surface = MakeSurface(Plate());
            Draw(surface);
            Assert.IsFalse(GUI.Drawn.Contains("button Make a copy to edit"));
            surface.Grating = Preset("a");
            GUI.Pressed.Add("Make a copy to edit");
            Draw(surface);
            Assert.AreEqual("Assets/Gratings/a.asset", AssetDatabase.GetAssetPath(surface.Grating));
        }

        sealed class OtherImporter : AssetImporter
        {
            [SerializeField] internal bool _readWriteEnabled;
        }

        KnurlSurface MakeUnreadable(string path, AssetImporter importer)
        {
            Mesh mesh = Plate();
            mesh.UploadMeshData(true);
            AssetDatabase.Assets[path] = mesh;
            AssetImporter.Importers[path] = importer;
            return MakeSurface(mesh);
        }

        [Test]
        public void A_mesh_is_made_readable_at_a_button_beside_its_warning()
        {
            var model = new ModelImporter();
            KnurlSurface surface = MakeUnreadable("Assets/a.fbx", model);
            Draw(surface);
            CollectionAssert.Contains(GUI.Drawn, "button Make readable");
            Assert.IsFalse(model.isReadable);
            GUI.Pressed.Add("Make readable");
            Draw(surface);
            Assert.IsTrue(model.isReadable);
            Assert.AreEqual(1, model.Reimports);
            var other = new OtherImporter(); // UnityGLTF's, by its field
            Draw(MakeUnreadable("Assets/b.glb", other));
            Assert.IsTrue(other._readWriteEnabled);
            Assert.AreEqual(1, other.Reimports);
        }

        [Test]
        public void Where_a_mesh_cannot_be_made_readable_there_is_no_button()
        {
            GUI.Drawn.Clear();
            Draw(MakeSurface(Plate())); // it is
            Draw(MakeUnreadable("Packages/x/a.fbx", new ModelImporter())); // it is not the project's
            Draw(MakeUnreadable("Assets/a.xyz", new AssetImporter())); // unknown importer
            CollectionAssert.DoesNotContain(GUI.Drawn, "button Make readable");
        }

        [Test]
        public void A_surfaces_warnings_are_drawn_below_it()
        {
            KnurlSurface surface = MakeSurface(null);
            surface.Grating = null;
            Draw(surface);
            foreach (string warning in surface.GetWarnings())
            {
                CollectionAssert.Contains(EditorGUILayout.Drawn, "Warning: " + warning);
            }
            Assert.AreEqual(2, surface.GetWarnings().Length);
        }

        [Test]
        public void A_surface_that_is_well_has_none()
        {
            Draw(MakeSurface(Plate()));
            Assert.IsFalse(EditorGUILayout.Drawn.Any(line => line.StartsWith("Warning")));
        }

        [Test]
        public void A_device_tells_what_it_does()
        {
            KnurlDevice device = MakeDevice();
            Draw(device);
            CollectionAssert.Contains(EditorGUILayout.Drawn,
                "Info: It does not run; settings count from the next start on.");
            EditorGUILayout.Drawn.Clear();
            Assert.IsTrue(device.StartDevice());
            Draw(device);
            CollectionAssert.Contains(EditorGUILayout.Drawn, "property rate as Rate (Hz)");
            CollectionAssert.Contains(EditorGUILayout.Drawn, "label Running: " + device.DeviceName);
            CollectionAssert.Contains(EditorGUILayout.Drawn, "label Touched: nothing");
        }

        [Test]
        public void A_known_device_is_put_into_its_field()
        {
            KnurlDevice device = MakeDevice();
            EditorGUILayout.Answers["Known devices"] = true;
            Draw(device);
            GenericMenu.Shown.Items["falcon"]();
            Assert.AreEqual("falcon", device.Device);
        }

        [Test]
        public void A_devices_box_has_the_size_of_what_it_reaches()
        {
            KnurlDevice device = MakeDevice("touch");
            Hooks.DrawGizmo(device);
            CollectionAssert.Contains(Gizmos.Drawn,
                "wire cube " + Vector3.zero + " " + new Vector3(0.16f, 0.12f, 0.07f));
        }

        static Vector3 BoxCentre(KnurlDevice device)
        {
            Gizmos.WireCubes.Clear();
            Hooks.DrawGizmo(device);
            return Gizmos.WireCubes.Single().MultiplyPoint3x4(Vector3.zero);
        }

        /// <summary>As felt: the workspace moves with the object, at the scale of the start.</summary>
        [Test]
        public void A_running_devices_box_goes_with_its_object()
        {
            KnurlDevice device = MakeDevice();
            device.transform.position = Vector3.up;
            Assert.AreEqual(Vector3.up, BoxCentre(device));
            Assert.IsTrue(device.StartDevice());
            device.transform.position = Vector3.right;
            device.WorkspaceScale = 3f;
            Player.Frames(2);
            Assert.AreEqual(Vector3.right, BoxCentre(device));
            Assert.AreEqual(3f, Gizmos.WireCubes.Single().MultiplyVector(Vector3.right).magnitude, 1e-6f);
            device.StopDevice();
            Assert.AreEqual(Vector3.right, BoxCentre(device));
        }

        [Test]
        public void A_running_device_shows_its_hip()
        {
            KnurlDevice device = MakeDevice();
            Assert.IsTrue(device.StartDevice());
            Assert.IsTrue(Player.Until(() => device.Ticks > 0));
            Hooks.DrawGizmo(device);
            Assert.AreEqual(1, Gizmos.Drawn.Count(line => line.StartsWith("sphere")));
        }

        [Test]
        public void A_surfaces_ridges_are_drawn_and_drawn_anew_when_its_grating_changes()
        {
            KnurlSurface surface = MakeSurface(Plate(0.0101f)); // 1 mm ridges on two triangles
            int first = Lines(surface);
            Assert.That(first, Is.InRange(18, 24));
            surface.Grating.SpatialFrequency = new Vector2(2000f, 0f);
            Assert.That(Lines(surface), Is.InRange(36, 46));
            surface.Grating = null;
            Assert.AreEqual(0, Lines(surface));
        }

        static int Lines(KnurlSurface surface)
        {
            EditorGUILayout.Drawn.Clear();
            Hooks.DrawGizmo(surface);
            string drawn = EditorGUILayout.Drawn.FirstOrDefault(line => line.StartsWith("handle lines "));
            return drawn == null ? 0 : int.Parse(drawn.Substring("handle lines ".Length));
        }

        [Test]
        public void Devices_stop_when_the_editor_quits()
        {
            KnurlDevice device = MakeDevice();
            Assert.IsTrue(device.StartDevice());
            EditorApplication.Quit();
            Assert.IsFalse(device.Running);
        }
    }
}
