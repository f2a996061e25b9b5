// SPDX-License-Identifier: MIT
using System;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using Knurl.Cases;
using Knurl.Editing;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEditor.Build.Content;
using UnityEditor.Build.Reporting;
using UnityEditor.SceneManagement;
using UnityEngine;
using UnityEngine.Rendering;
using UnityEngine.SceneManagement;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    /// <summary>Surfaces whose meshes a player would lose: their geometry is stored while scenes are built.</summary>
    [TestFixture]
    public sealed class BuildCases : Suite
    {
        [SetUp]
        public void SetUp()
        {
            Player.Clear();
            GameObjectUtility.Flags.Clear();
            PlayerSettings.stripUnusedMeshComponents = false;
        }

        [TearDown]
        public void TearDown()
        {
            Application.isEditor = true;
            Player.Clear();
            StageUtility.Open = null;
            PlayerSettings.stripUnusedMeshComponents = false;
        }

        KnurlSurface MakeShown(params ShaderPropertyType[] properties)
        {
            KnurlSurface surface = MakeSurface(Plate());
            surface.gameObject.AddComponent<MeshRenderer>().sharedMaterial =
                new Material(new Shader { Properties = properties });
            return surface;
        }

        static void Process(BuildReport report, params KnurlSurface[] surfaces)
        {
            GameObject[] roots = surfaces.Select(surface => surface.gameObject).ToArray();
            new SceneStep().OnProcessScene(new Scene { Path = "Assets/a.unity", Roots = roots }, report);
        }

        static Mesh MeshOf(KnurlSurface surface)
        {
            return surface.GetComponent<MeshFilter>().sharedMesh;
        }

        /// <summary>In a player, with Unity's mesh as it would be there: the force of the wall, and the ridges.</summary>
        void IsFelt(KnurlSurface surface)
        {
            MeshOf(surface).UploadMeshData(true);
            Application.isEditor = false;
            Player.EnterPlayMode();
            Assert.AreEqual(new string[0], surface.GetWarnings());
            Assert.AreEqual(32, Ridges(surface, Vector3.zero, Vector3.right), 1, "ridges of 1 mm on 0.8 of 40 mm");
        }

        [Test]
        public void An_unreadable_mesh_is_felt_in_the_player()
        {
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            MeshOf(surface).UploadMeshData(true);
            Process(new BuildReport(), surface);
            IsFelt(surface);
        }

        [Test]
        public void A_mesh_that_static_batching_will_merge_is_felt_in_the_player()
        {
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            GameObjectUtility.Flags[surface.gameObject] = StaticEditorFlags.BatchingStatic;
            Process(new BuildReport(), surface);
            surface.GetComponent<MeshFilter>().sharedMesh = Made(new Mesh { name = "Combined Mesh" });
            IsFelt(surface);
        }

        [Test]
        public void A_mesh_that_was_merged_before_is_told_and_not_stored()
        {
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            GameObjectUtility.Flags[surface.gameObject] = StaticEditorFlags.BatchingStatic;
            surface.GetComponent<Renderer>().isPartOfStaticBatch = true;
            LogAssert.Expect(LogType.Warning, new Regex("Assets/a.unity: the surface 'Plate'.*merged.*clear Batching Static"));
            Process(new BuildReport(), surface);
            Assert.That(surface.Geometry == null);
        }

        /// <summary>The step as Unity 7 compiles it: a postprocessor, which other postprocessors precede or follow by
        /// order.</summary>
        [Test]
        public void In_unity_7_geometry_is_stored_before_other_postprocessors_and_again_if_the_mesh_changes()
        {
            string file = Path.Combine(Environment.GetEnvironmentVariable("KNURL_TEST_FOLDER"), "newest/Knurl.Haptics.Editor.dll");
            Type type = Assembly.Load(File.ReadAllBytes(file)).GetType("Knurl.Editing.SceneStep", true);
            var step = (AssetPostprocessor)Activator.CreateInstance(type);
            step.context = new AssetImportContext();
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            MeshOf(surface).UploadMeshData(true);
            AssetDatabase.Assets["Assets/plate.fbx"] = MeshOf(surface);
            var scene = new Scene { Path = "Assets/a.unity", Roots = new[] { surface.gameObject } };
            type.GetMethod("OnProcessScene", BindingFlags.Instance | BindingFlags.NonPublic)
                .Invoke(step, new object[] { scene, new SceneImportContext(ProcessSceneMode.PlayerBuild) });
            AssetDatabase.Assets.Remove("Assets/plate.fbx");
            Assert.Less(step.GetPostprocessOrder(), 0, "Unity's own has 0");
            CollectionAssert.AreEqual(new[] { BuildCheck.Dependency, "Assets/plate.fbx" }, step.context.Dependencies);
            IsFelt(surface);
        }

        [Test]
        public void A_build_says_whether_mesh_data_is_optimized_before_scenes_are_processed()
        {
            new BuildCheck().OnPreprocessBuild(new BuildReport());
            Hash128 before = AssetDatabase.Dependencies[BuildCheck.Dependency];
            PlayerSettings.stripUnusedMeshComponents = true;
            new BuildCheck().OnPreprocessBuild(new BuildReport());
            Assert.AreNotEqual(before, AssetDatabase.Dependencies[BuildCheck.Dependency]);
        }

        [Test]
        public void A_mesh_that_loses_its_uvs_keeps_its_direction_in_the_player()
        {
            PlayerSettings.stripUnusedMeshComponents = true;
            KnurlSurface surface = MakeShown(ShaderPropertyType.Color);
            Process(new BuildReport(), surface);
            MeshOf(surface).uv = null;
            IsFelt(surface);
        }

        [Test]
        public void Surfaces_that_show_one_mesh_share_what_is_stored()
        {
            KnurlSurface one = MakeShown(ShaderPropertyType.Texture), two = MakeShown(ShaderPropertyType.Texture);
            two.GetComponent<MeshFilter>().sharedMesh = MeshOf(one);
            MeshOf(one).UploadMeshData(true);
            Process(new BuildReport(), one, two);
            Assert.That(one.Geometry, Is.Not.Null.And.SameAs(two.Geometry));
        }

        [Test]
        public void Meshes_that_a_player_can_read_are_not_stored_twice()
        {
            PlayerSettings.stripUnusedMeshComponents = true;
            KnurlSurface plain = MakeShown(ShaderPropertyType.Color), ruled = MakeShown();
            ruled.Axis = Vector3.right;
            Process(null, plain); // played in the editor, which strips nothing
            Process(new BuildReport(), MakeShown(ShaderPropertyType.Color, ShaderPropertyType.Texture), ruled);
            PlayerSettings.stripUnusedMeshComponents = false;
            Process(new BuildReport(), plain);
            Assert.That(plain.Geometry == null && ruled.Geometry == null);
        }

        /// <summary>Only scenes are processed in a build.</summary>
        [Test]
        public void A_prefabs_surface_is_warned_of_until_it_is_stored()
        {
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            MeshOf(surface).UploadMeshData(true);
            AssetDatabase.CreateAsset(surface.gameObject, "Assets/a.prefab");
            LogAssert.Expect(LogType.Warning, new Regex("Assets/a.prefab: the surface 'a'.*Read/Write.*Store geometry"));
            new BuildCheck().OnPreprocessBuild(new BuildReport());
            StageUtility.Open = surface.gameObject;
            Press(surface, "Store geometry");
            Assert.AreEqual("Assets/Gratings/plate geometry.asset", AssetDatabase.GetAssetPath(surface.Geometry));
            new BuildCheck().OnPreprocessBuild(new BuildReport());
            LogAssert.NoUnexpectedReceived();
            IsFelt(surface);
        }

        [Test]
        public void Geometry_that_is_stored_again_stays_the_same_asset()
        {
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            MeshOf(surface).UploadMeshData(true);
            AssetDatabase.CreateAsset(surface.gameObject, "Assets/a.prefab");
            StageUtility.Open = surface.gameObject;
            Press(surface, "Store geometry");
            KnurlGeometry first = surface.Geometry;
            Mesh felt = first.Mesh;
            int assets = AssetDatabase.Assets.Count;
            MeshOf(surface).vertices = MeshOf(surface).vertices.Select(place => 2f * place).ToArray();
            Press(surface, "Store geometry again");
            Assert.AreSame(first, surface.Geometry);
            Assert.AreEqual(assets, AssetDatabase.Assets.Count);
            Assert.That(felt == null, "its mesh of before is gone");
            CollectionAssert.AreEqual(MeshOf(surface).vertices, first.Mesh.vertices);
        }

        static void Press(KnurlSurface surface, string button)
        {
            GUI.Pressed.Add(button);
            Hooks.EditorOf(surface).OnInspectorGUI();
            GUI.Pressed.Clear();
        }

        [TestCase(true)]
        [TestCase(false)]
        public void A_player_keeps_stored_triangles_once(bool isEditor)
        {
            KnurlGeometry geometry = Made(KnurlGeometry.Of(Made(Plate())));
            Application.isEditor = isEditor;
            Assert.AreEqual(4, geometry.Mesh.vertexCount);
            FieldInfo field = typeof(KnurlGeometry).GetField("vertices", BindingFlags.Instance | BindingFlags.NonPublic);
            Assert.AreEqual(isEditor ? 4 : 0, ((Vector3[])field.GetValue(geometry)).Length);
        }

        /// <summary>A prefab has stored its mesh, which is another now.</summary>
        [Test]
        public void A_mesh_that_has_changed_since_is_stored_again_in_scenes_and_warned_of_in_prefabs()
        {
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            surface.Geometry = KnurlGeometry.Of(MeshOf(surface));
            MeshOf(surface).vertices = MeshOf(surface).vertices.Select(place => 2f * place).ToArray();
            AssetDatabase.CreateAsset(surface.gameObject, "Assets/a.prefab");
            LogAssert.Expect(LogType.Warning, new Regex("Assets/a.prefab: the surface 'a'.*changed.*Store geometry again"));
            new BuildCheck().OnPreprocessBuild(new BuildReport());
            Process(new BuildReport(), surface);
            CollectionAssert.AreEqual(MeshOf(surface).vertices, surface.Geometry.Mesh.vertices);
            new BuildCheck().OnPreprocessBuild(new BuildReport());
            LogAssert.NoUnexpectedReceived();
        }

        [Test]
        public void A_mesh_that_a_game_changes_is_felt_in_place_of_the_stored_one()
        {
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            surface.Geometry = KnurlGeometry.Of(MeshOf(surface));
            Application.isEditor = false;
            Player.EnterPlayMode();
            Mesh other = Made(Plate()), felt;
            surface.GetComponent<MeshFilter>().sharedMesh = other;
            surface.FindMesh(out felt);
            Assert.AreSame(surface.Geometry.Mesh, felt);
            surface.UpdateMesh();
            surface.FindMesh(out felt);
            Assert.AreSame(other, felt);
        }

        [Test]
        public void A_mesh_without_triangles_is_told()
        {
            KnurlSurface surface = MakeShown(ShaderPropertyType.Texture);
            surface.GetComponent<MeshFilter>().sharedMesh = Made(new Mesh { name = "Nothing" });
            MeshOf(surface).UploadMeshData(true);
            LogAssert.Expect(LogType.Warning, new Regex("Assets/a.unity: the surface 'Plate'.*'Nothing'"));
            Process(new BuildReport(), surface);
        }
    }
}
