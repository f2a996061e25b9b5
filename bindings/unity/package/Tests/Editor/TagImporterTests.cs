// SPDX-License-Identifier: MIT
using System.IO;
using System.Text;
using System.Text.RegularExpressions;
using Knurl.Editing;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    [TestFixture]
    public sealed class TagImporterTests
    {
        const string Folder = GltfFiles.Folder + "/plate.gltf Gratings";
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
        }

        static void ExpectWarning(string pattern)
        {
            LogAssert.Expect(LogType.Warning, new Regex(pattern));
        }

        [Test]
        public void A_right_tag_becomes_a_grating_in_a_folder_beside_the_file()
        {
            string path = files.Write("plate.gltf", "Plate", GltfFiles.Tag(1000), "Bare", "");
            Assert.AreEqual(1, TagImporter.Import(path));
            KnurlGrating grating = GltfFiles.Grating(Folder + "/Plate.asset");
            Assert.IsNotNull(grating);
            Assert.AreEqual("Plate", grating.name);
            Assert.AreEqual(new Vector2(1000f, 0f), grating.SpatialFrequency);
            Assert.AreEqual(0.0002f, grating.Amplitude);
            Assert.AreEqual(400f, grating.Stiffness);
            Assert.AreEqual(0.25f, grating.Friction);
            Assert.IsNull(GltfFiles.Grating(Folder + "/Bare.asset"));
        }

        [Test]
        public void Imported_again_a_file_updates_the_same_asset()
        {
            string path = files.Write("plate.gltf", "Plate", GltfFiles.Tag(1000));
            TagImporter.Import(path);
            KnurlGrating first = GltfFiles.Grating(Folder + "/Plate.asset");
            files.Write("plate.gltf", "Plate", GltfFiles.Tag(500), "New", GltfFiles.Tag(250));
            Assert.AreEqual(2, TagImporter.Import(path));
            Assert.AreSame(first, GltfFiles.Grating(Folder + "/Plate.asset"));
            Assert.AreEqual(500f, first.SpatialFrequency.x);
            Assert.AreEqual(250f, GltfFiles.Grating(Folder + "/New.asset").SpatialFrequency.x);
        }

        [Test]
        public void A_grating_whose_tag_is_gone_stays_for_those_who_use_it()
        {
            string path = files.Write("plate.gltf", "Plate", GltfFiles.Tag(1000));
            TagImporter.Import(path);
            files.Write("plate.gltf", "Other", GltfFiles.Tag(500));
            TagImporter.Import(path);
            Assert.AreEqual(1000f, GltfFiles.Grating(Folder + "/Plate.asset").SpatialFrequency.x);
        }

        [Test]
        public void A_users_grating_of_the_same_name_is_left_alone()
        {
            string path = files.Write("plate.gltf", "Plate", GltfFiles.Tag(1000), "Other", GltfFiles.Tag(500));
            AssetDatabase.CreateFolder(GltfFiles.Folder, "plate.gltf Gratings");
            var own = ScriptableObject.CreateInstance<KnurlGrating>();
            own.Stiffness = 123f;
            AssetDatabase.CreateAsset(own, Folder + "/Plate.asset");
            ExpectWarning("Plate\\.asset was not made of a tag .* stays as it is");
            TagImporter.Import(path);
            Assert.AreEqual(123f, GltfFiles.Grating(Folder + "/Plate.asset").Stiffness);
            Assert.IsNotNull(GltfFiles.Grating(Folder + "/Other.asset"));
        }

        [Test]
        public void A_wrong_tag_is_a_warning_that_names_file_object_and_key_and_nothing_is_made()
        {
            string path = files.Write("plate.gltf", "Plate", "{\"knurl_stiffness\": -1}");
            ExpectWarning("^Knurl: Assets/KnurlEditorTests/plate\\.gltf: node 'Plate' \\(0\\): "
                + "knurl_stiffness: expected");
            Assert.AreEqual(-1, TagImporter.Import(path));
            Assert.IsFalse(AssetDatabase.IsValidFolder(Folder));
        }

        [Test]
        public void A_wrong_tag_leaves_the_gratings_of_the_last_right_import()
        {
            string path = files.Write("plate.gltf", "Plate", GltfFiles.Tag(1000));
            TagImporter.Import(path);
            files.Write("plate.gltf", "Plate", "{\"knurl_stiffness\": \"hard\"}");
            ExpectWarning("knurl_stiffness");
            TagImporter.Import(path);
            Assert.AreEqual(1000f, GltfFiles.Grating(Folder + "/Plate.asset").SpatialFrequency.x);
        }

        [Test]
        public void A_file_that_is_gone_is_a_warning()
        {
            ExpectWarning("^Knurl: Assets/KnurlEditorTests/none\\.glb: ");
            Assert.AreEqual(-1, TagImporter.Import(GltfFiles.Folder + "/none.glb"));
        }

        [Test]
        public void A_file_without_tags_costs_no_load_and_no_warning()
        {
            // Knurl's loader would refuse it.
            string path = GltfFiles.Folder + "/packed.gltf";
            File.WriteAllText(path, "{\"asset\": {\"version\": \"2.0\"}, "
                + "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"]}");
            Assert.AreEqual(0, TagImporter.Import(path));
        }

        [Test]
        public void Only_gltf_files_below_Assets_are_looked_at()
        {
            Assert.IsTrue(TagImporter.IsGltf("Assets/a.gltf"));
            Assert.IsTrue(TagImporter.IsGltf("Assets/Models/A.GLB"));
            Assert.IsFalse(TagImporter.IsGltf("Assets/a.fbx"));
            Assert.IsFalse(TagImporter.IsGltf("Assets/a.glb.asset"));
            Assert.IsFalse(TagImporter.IsGltf("Packages/com.some.thing/a.glb"));
        }

        [Test]
        public void Gratings_move_along_with_their_file()
        {
            TagImporter.Import(files.Write("plate.gltf", "Plate", GltfFiles.Tag(1000)));
            KnurlGrating grating = GltfFiles.Grating(Folder + "/Plate.asset");
            TagAssets.Move(GltfFiles.Folder + "/plate.gltf", GltfFiles.Folder + "/door.gltf");
            Assert.AreSame(grating, GltfFiles.Grating(GltfFiles.Folder + "/door.gltf Gratings/Plate.asset"));
        }

        [TestCase("Plate", "Plate")]
        [TestCase("Body / Steel", "Body _ Steel")]
        [TestCase("a\\b:c*d?e\"f<g>h|i", "a_b_c_d_e_f_g_h_i")]
        [TestCase("", "surface")]
        [TestCase(" . ", "surface")]
        [TestCase(".hidden", "hidden")]
        [TestCase("backup~", "backup")]
        [TestCase("dots...", "dots")]
        [TestCase("tab\there", "tab_here")]
        [TestCase("CON", "_CON")]
        [TestCase("nul.x", "_nul.x")]
        [TestCase("Übergröße", "Übergröße")]
        public void Names_become_what_every_file_system_takes(string name, string expected)
        {
            Assert.AreEqual(expected, TagAssets.Sanitise(name));
        }

        [Test]
        public void Long_names_are_cut()
        {
            Assert.LessOrEqual(TagAssets.Sanitise(new string('x', 300)).Length, 80);
        }

        [Test]
        public void Names_that_become_the_same_are_told_apart_where_capitals_do_not_count()
        {
            string[] paths = TagAssets.PathsOf("Assets/a.glb", new[] { "a:b", "a_b", "A?B", "c" });
            CollectionAssert.AreEqual(new[]
            {
                "Assets/a.glb Gratings/a_b.asset", "Assets/a.glb Gratings/a_b (2).asset",
                "Assets/a.glb Gratings/A_B (3).asset", "Assets/a.glb Gratings/c.asset",
            }, paths);
        }

        /// <summary>Writes a .glb with these texts as JSON chunk and binary chunk.</summary>
        string WriteGlb(string json, string binary)
        {
            string path = GltfFiles.Folder + "/chunks.glb";
            using (var writer = new BinaryWriter(File.Create(path)))
            {
                writer.Write(0x46546C67u);
                writer.Write(2u);
                writer.Write((uint)(28 + json.Length + binary.Length));
                writer.Write((uint)json.Length);
                writer.Write(0x4E4F534Au);
                writer.Write(Encoding.ASCII.GetBytes(json));
                writer.Write((uint)binary.Length);
                writer.Write(0x004E4942u);
                writer.Write(Encoding.ASCII.GetBytes(binary));
            }
            return path;
        }

        [TestCase("{\"knurl_amplitude\": 1}", "", true)]
        [TestCase("{\"kknurl\": 1}", "", true)]
        [TestCase("{\"knur\": \"l\"}", "", false)]
        [TestCase("{}", "knurl", false)]
        [TestCase("", "", false)]
        public void A_glb_is_looked_at_as_far_as_its_json_goes(string json, string binary, bool expected)
        {
            Assert.AreEqual(expected, GltfText.MayHoldTags(WriteGlb(json, binary)));
        }

        [Test]
        public void A_tag_across_two_blocks_is_found()
        {
            for (int before = 65536 - 6; before <= 65536; before++)
            {
                Assert.IsTrue(GltfText.MayHoldTags(WriteGlb(new string(' ', before) + "knurl", "")), before.ToString());
            }
        }

        [Test]
        public void A_short_file_holds_no_tag()
        {
            string path = GltfFiles.Folder + "/short.glb";
            File.WriteAllBytes(path, new byte[] { 0x67, 0x6C, 0x54, 0x46 });
            Assert.IsFalse(GltfText.MayHoldTags(path));
        }
    }
}
