// SPDX-License-Identifier: MIT
using System;
using System.Linq;
using System.Reflection;
using Knurl.Tests;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Knurl.Cases
{
    /// <summary>The editor's hooks, called as Unity calls them: by their attributes and names.</summary>
    internal static class Hooks
    {
        const BindingFlags Any = BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;
        static readonly Type[] Types = Assembly.Load("Knurl.Haptics.Editor").GetTypes();

        internal static object CallMenu(string path, bool validate, Object context = null)
        {
            foreach (MethodInfo method in Types.SelectMany(type => type.GetMethods(Any)))
            {
                foreach (MenuItem item in method.GetCustomAttributes(typeof(MenuItem), false))
                {
                    if (item.menuItem == path && item.validate == validate)
                    {
                        bool takesCommand = method.GetParameters().Length == 1;
                        return method.Invoke(null, takesCommand ? new object[] { new MenuCommand(context) } : null);
                    }
                }
            }
            Assert.Fail("there is no menu " + path + (validate ? ", to validate" : ""));
            return null;
        }

        internal static void DrawGizmo(Component component)
        {
            MethodInfo found = Types.SelectMany(type => type.GetMethods(Any))
                .Single(method => method.IsDefined(typeof(DrawGizmo), false)
                    && method.GetParameters()[0].ParameterType == component.GetType());
            found.Invoke(null, new object[] { component, GizmoType.Selected });
        }

        internal static Editor EditorOf(Object target)
        {
            Type found = Types.Single(type => type.GetCustomAttributes(typeof(CustomEditor), false)
                .Cast<CustomEditor>().Any(editor => editor.InspectedType == target.GetType()));
            return Editor.CreateEditor(target, found);
        }

        internal static void Postprocess(string[] imported, string[] moved = null, string[] movedFrom = null)
        {
            string[] none = new string[0];
            foreach (MethodInfo method in Types.Where(type => typeof(AssetPostprocessor).IsAssignableFrom(type))
                .Select(type => type.GetMethod("OnPostprocessAllAssets", Any)).Where(method => method != null))
            {
                method.Invoke(null, new object[] { imported, none, moved ?? none, movedFrom ?? none });
            }
        }
    }

    [TestFixture]
    public sealed class Menus
    {
        GltfFiles files;

        [SetUp]
        public void SetUp()
        {
            files = new GltfFiles();
        }

        [TearDown]
        public void TearDown()
        {
            files.Dispose();
            Selection.objects = new Object[0];
            EditorUtility.Chosen = "";
            Player.LeaveScene();
        }

        [Test]
        public void A_new_device_lies_below_what_was_clicked_and_is_selected()
        {
            var parent = new GameObject("Parent");
            Hooks.CallMenu("GameObject/Knurl/Haptic Device", false, parent);
            var made = Selection.activeGameObject;
            Assert.IsNotNull(made.GetComponent<KnurlDevice>());
            Assert.AreSame(parent.transform, made.transform.parent);
            Assert.AreEqual("Create Haptic Device", Undo.Steps.Last());
        }

        [Test]
        public void Surfaces_go_to_selected_meshes_that_have_none()
        {
            GameObject mesh = GltfFiles.Felt("Mesh", null), bare = new GameObject("Bare");
            Selection.objects = new Object[] { bare };
            Assert.AreEqual(false, Hooks.CallMenu("GameObject/Knurl/Add Surface To Selection", true));
            Selection.objects = new Object[] { mesh, bare };
            Assert.AreEqual(true, Hooks.CallMenu("GameObject/Knurl/Add Surface To Selection", true));
            Hooks.CallMenu("GameObject/Knurl/Add Surface To Selection", false);
            Hooks.CallMenu("GameObject/Knurl/Add Surface To Selection", false); // Unity calls it once for each object
            Assert.AreEqual(1, mesh.GetComponents<KnurlSurface>().Length);
            Assert.IsNull(bare.GetComponent<KnurlSurface>());
        }

        [Test]
        public void An_import_makes_gratings_and_a_rename_takes_them_along()
        {
            string path = files.Write("a.gltf", "Plate", GltfFiles.Tag(1000));
            Hooks.Postprocess(new[] { "Assets/other.png", path });
            KnurlGrating grating = GltfFiles.Grating(path + " Gratings/Plate.asset");
            Assert.AreEqual(1000f, grating.SpatialFrequency.x);
            string renamed = GltfFiles.Folder + "/b.gltf";
            System.IO.File.Move(path, renamed);
            Hooks.Postprocess(new[] { renamed }, new[] { renamed }, new[] { path });
            Assert.AreSame(grating, GltfFiles.Grating(renamed + " Gratings/Plate.asset"));
        }

        [Test]
        public void Surfaces_from_a_chosen_file_are_added_below_the_selected_object()
        {
            string path = files.Write("a.gltf", "Plate", GltfFiles.Tag(1000));
            var root = new GameObject("Root");
            GameObject plate = GltfFiles.Felt("Plate", root.transform);
            Selection.activeGameObject = root;
            Assert.AreEqual(true, Hooks.CallMenu("GameObject/Knurl/Add Surfaces From glTF Tags", true));
            Hooks.CallMenu("GameObject/Knurl/Add Surfaces From glTF Tags", false); // nothing chosen
            Assert.IsNull(plate.GetComponent<KnurlSurface>());
            EditorUtility.Chosen = "/home/someone/Project/" + path;
            Hooks.CallMenu("GameObject/Knurl/Add Surfaces From glTF Tags", false);
            KnurlGrating given = plate.GetComponent<KnurlSurface>().Grating;
            Assert.AreSame(GltfFiles.Grating(path + " Gratings/Plate.asset"), given);
            CollectionAssert.Contains(Undo.Steps, "Add Knurl Surfaces");
        }

        [Test]
        public void A_file_that_is_no_gltf_or_not_of_the_project_is_refused()
        {
            Selection.activeGameObject = new GameObject("Root");
            foreach (string chosen in new[] { "/tmp/a.glb", "/home/someone/Project/Assets/a.fbx" })
            {
                EditorUtility.Chosen = chosen;
                UnityEngine.TestTools.LogAssert.Expect(LogType.Warning,
                    "Knurl: expected a .gltf or .glb file below the project's Assets, found " + chosen);
                Hooks.CallMenu("GameObject/Knurl/Add Surfaces From glTF Tags", false);
            }
        }

        [Test]
        public void Tags_of_selected_files_are_read_once_more()
        {
            string path = files.Write("a.gltf", "Plate", GltfFiles.Tag(1000));
            var asset = new TextAsset("");
            AssetDatabase.Assets[path] = asset;
            Selection.objects = new Object[] { asset };
            Assert.AreEqual(true, Hooks.CallMenu("Assets/Knurl/Read Tags", true));
            Hooks.CallMenu("Assets/Knurl/Read Tags", false);
            Assert.IsNotNull(GltfFiles.Grating(path + " Gratings/Plate.asset"));
        }
    }
}
