// SPDX-License-Identifier: MIT
using System;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using GLTF.Schema;
using GLTFast;
using Knurl.Editing;
using Knurl.Importing;
using Newtonsoft.Json.Linq;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEngine;
using UnityEngine.TestTools;
using UnityGLTF.Plugins;
using Fast = GLTFast.Schema;
using FastNewtonsoft = GLTFast.Newtonsoft.Schema;
using Object = UnityEngine.Object;

namespace Knurl.Tests
{
    /// <summary>Tags attach by themselves while UnityGLTF and glTFast import a file. Both are stand-ins (stubs/importers),
    /// after UnityGLTF 2.16 and glTFast 6.19; Knurl's part is the package's.</summary>
    [TestFixture]
    public sealed class ImporterCases
    {
        const string Tag = "{\"knurl\": {\"version\": 1, \"spatial_frequency\": 1000, \"amplitude\": 0.0002, "
            + "\"stiffness\": 400MORE}}";
        const string Flat = "{\"knurl_spatial_frequency\": [500, 250], \"knurl_amplitude\": 0.0002, \"knurl_stiffness\": 400}";

        readonly AssetImportContext context = new AssetImportContext();
        GameObject made;

        static string With(string more)
        {
            return Tag.Replace("MORE", more);
        }

        static JToken Json(string text)
        {
            return text == null ? null : new JToken(text);
        }

        [TestFixtureSetUp]
        public void Register()
        {
            MethodInfo register = typeof(KnurlTagsAddon).GetMethod("Register", BindingFlags.NonPublic | BindingFlags.Static);
            register.Invoke(null, null);
            register.Invoke(null, null); // as in the editor: when scripts load, and when play mode begins
        }

        [SetUp]
        public void SetUp()
        {
            context.Added.Clear();
            context.Dependencies.Clear();
            PrefabUtility.Sources.Clear();
        }

        [TearDown]
        public void TearDown()
        {
            ImportedFile.End();
            Object.DestroyImmediate(made);
        }

        /// <summary>As Unity calls it before an importer runs.</summary>
        void Preprocess(string path)
        {
            var processor = new TagImporter { assetPath = path, context = context };
            typeof(TagImporter).GetMethod("OnPreprocessAsset", BindingFlags.Instance | BindingFlags.NonPublic)
                .Invoke(processor, null);
        }

        void PreprocessTagged()
        {
            using (var files = new GltfFiles())
            {
                Preprocess(files.Write("model.gltf", "Plate", GltfFiles.Tag(1000)));
            }
        }

        /// <summary>A node with a mesh of one primitive, imported by UnityGLTF.</summary>
        KnurlSurface ByUnityGltf(string node, string mesh, string material, bool isDoubleSided = false, int instances = 0)
        {
            var root = new GLTFRoot();
            root.Materials.Add(new GLTFMaterial { Extras = Json(material), DoubleSided = isDoubleSided });
            var primitive = new MeshPrimitive { Material = new MaterialId { Id = 0, Root = root } };
            root.Meshes.Add(new GLTFMesh { Name = "Mesh", Extras = Json(mesh) });
            root.Meshes[0].Primitives = new[] { primitive }.ToList();
            root.Nodes.Add(new Node
            {
                Name = "Plate", Extras = Json(node), Mesh = new MeshId { Id = 0, Root = root }, Instances = instances
            });
            root.Nodes.Add(new Node { Name = "Empty", Extras = Json(node) });
            var import = new GLTFImportContext();
            import.Plugins.Add(ScriptableObject.CreateInstance<KnurlTagsImport>().CreateInstance(import));
            made = import.Import(root);
            return made.GetComponentsInChildren<KnurlSurface>(true).FirstOrDefault();
        }

        [TestCase("node")]
        [TestCase("mesh")]
        [TestCase("material")]
        public void UnityGltfs_extras_attach_wherever_they_are(string at)
        {
            KnurlSurface surface = ByUnityGltf(at == "node" ? With("") : null, at == "mesh" ? With("") : null,
                at == "material" ? With("") : null);
            Assert.AreEqual("Plate", surface.name);
            Assert.AreEqual(new Vector2(1000f, 0f), surface.Grating.SpatialFrequency);
            Assert.AreEqual(Vector3.zero, surface.Axis);
            Assert.That(!surface.BoxCoordinates && !surface.DoubleSided);
        }

        /// <summary>EXT_mesh_gpu_instancing: UnityGLTF makes an object for each instance, and tells of the node alone.</summary>
        [Test]
        public void Each_of_unitygltfs_instances_is_felt_with_one_grating()
        {
            PreprocessTagged();
            ByUnityGltf(With(""), null, null, false, 3);
            IsFeltThrice("Instance 0", "Instance 1", "Instance 2");
        }

        void IsFeltThrice(params string[] names)
        {
            KnurlSurface[] surfaces = made.GetComponentsInChildren<KnurlSurface>(true);
            CollectionAssert.AreEquivalent(names, surfaces.Select(surface => surface.name));
            Assert.AreEqual(1, surfaces.Select(surface => surface.Grating).Distinct().Count());
            Assert.AreSame(surfaces[0].Grating, context.Added.Values.Single());
            Assert.AreEqual(new Vector2(1000f, 0f), surfaces[0].Grating.SpatialFrequency);
        }

        /// <summary>The same of glTFast, whose instances are children of the node's object; a child node stays as it
        /// is.</summary>
        [TestCase(true)]
        [TestCase(false)]
        public void Each_of_gltfasts_instances_is_felt_with_one_grating(bool byMaterial)
        {
            PreprocessTagged();
            FastNewtonsoft.Root root = FastRoot("knurl", "{\"version\": 1, \"spatial_frequency\": 1000, \"amplitude\": 0.0002, "
                + "\"stiffness\": 400}");
            FastNewtonsoft.UnclassifiedData extras = root.materials[0].extras;
            root.materials[0].extras = byMaterial ? extras : null;
            root.nodes[0].extras = byMaterial ? null : extras;
            root.nodes[0].Instances = 3;
            made = new GltfImportBase<FastNewtonsoft.Root>(root).Instantiate();
            IsFeltThrice("Mesh_i0", "Mesh_i1", "Mesh_i2");
        }

        [Test]
        public void A_nodes_keys_override_its_meshs_and_its_materials()
        {
            KnurlSurface surface = ByUnityGltf("{\"knurl_stiffness\": 700}", "{\"knurl_friction\": 0.5, \"note\": [1, {}]}",
                Flat, true);
            Assert.AreEqual(new Vector2(500f, 250f), surface.Grating.SpatialFrequency);
            Assert.AreEqual(700f, surface.Grating.Stiffness);
            Assert.AreEqual(0.5f, surface.Grating.Friction);
            Assert.That(surface.DoubleSided);
        }

        /// <summary>x is mirrored in Unity; the scale of the object plays no part.</summary>
        [Test]
        public void Axis_box_and_smoothness_are_the_tags()
        {
            Vector3 axis = ByUnityGltf(With(", \"axis\": [1, 2, 3], \"smooth\": 0"), null, null).Axis;
            Assert.AreEqual(0f, (new Vector3(-1f, 2f, 3f).normalized - axis).magnitude, 1e-6f);
            Assert.AreEqual(SurfaceSmoothness.Off, made.GetComponentInChildren<KnurlSurface>(true).Smooth);
            TearDown();
            Assert.That(ByUnityGltf(With(", \"coordinates\": \"box\""), null, null).BoxCoordinates);
        }

        [Test]
        public void Objects_without_a_tag_stay_as_they_are()
        {
            Assert.That(ByUnityGltf(null, "{\"made\": \"with knurl\"}", null) == null);
        }

        [Test]
        public void A_wrong_tag_is_a_warning_with_file_object_and_key()
        {
            PreprocessTagged();
            LogAssert.Expect(LogType.Warning, new Regex("Assets/KnurlEditorTests/model.gltf: node 'Plate'.*stiffness"));
            Assert.That(ByUnityGltf(With("").Replace("400", "-400"), null, null) == null);
        }

        [Test]
        public void In_the_editor_gratings_are_part_of_the_file_and_keep_their_identifiers()
        {
            PreprocessTagged();
            KnurlGrating first = ByUnityGltf(With(""), null, null).Grating;
            Assert.AreSame(first, context.Added["Knurl Scene/Plate"]);
            SetUp();
            PreprocessTagged();
            ByUnityGltf(Flat, null, null); // exported again, with other values
            Assert.AreEqual(500f, ((KnurlGrating)context.Added["Knurl Scene/Plate"]).SpatialFrequency.x);
        }

        [Test]
        public void In_a_game_gratings_belong_to_nothing()
        {
            ByUnityGltf(With(""), null, null);
            Assert.AreEqual(0, context.Added.Count);
        }

        static FastNewtonsoft.Root FastRoot(params string[] keysAndJson)
        {
            var extras = new FastNewtonsoft.UnclassifiedData();
            for (int i = 0; i < keysAndJson.Length; i += 2)
            {
                extras.Json.Add(keysAndJson[i], keysAndJson[i + 1]);
            }
            return new FastNewtonsoft.Root
            {
                nodes = new[] { new FastNewtonsoft.Node { name = "Plate", mesh = 0 } },
                meshes = new[] { new FastNewtonsoft.Mesh { name = "Mesh", materials = new[] { 1, 0 } } },
                materials = new[]
                {
                    new FastNewtonsoft.Material { extras = extras, doubleSided = true }, new FastNewtonsoft.Material()
                },
            };
        }

        [TestCase("knurl_spatial_frequency", "1000", "knurl_amplitude", "0.0002", "knurl_stiffness", "400")]
        [TestCase("knurl", "{\"version\": 1, \"spatial_frequency\": 1000, \"amplitude\": 0.0002, \"stiffness\": 400}")]
        public void Gltfasts_schema_attaches_to_the_object_of_the_tagged_primitive(params string[] keysAndJson)
        {
            made = new GltfImportBase<FastNewtonsoft.Root>(FastRoot(keysAndJson)).Instantiate();
            KnurlSurface surface = made.GetComponentsInChildren<KnurlSurface>(true).Single(); // once, though registered twice
            Assert.AreEqual("Mesh", surface.name, "the second primitive's object");
            Assert.AreEqual(new Vector2(1000f, 0f), surface.Grating.SpatialFrequency);
            Assert.That(surface.DoubleSided);
        }

        /// <summary>glTFast's importer in the editor reads JSON by Unity's reader, which drops extras: they come from the
        /// file.</summary>
        [Test]
        public void In_the_editor_gltfasts_tags_come_from_the_file()
        {
            using (var files = new GltfFiles())
            {
                string path = files.Write("model.gltf", "Plate", GltfFiles.Tag(1000), "Bare", "");
                Preprocess(path);
                made = new GltfImportBase<Fast.Root>(new Fast.Root
                {
                    nodes = new[] { new Fast.Node { name = "Plate", mesh = 0 }, new Fast.Node { name = "Bare", mesh = 0 } },
                    meshes = new[] { new Fast.Mesh { name = "Mesh", materials = new[] { -1 } } },
                }).Instantiate();
                KnurlSurface surface = made.GetComponentsInChildren<KnurlSurface>(true).Single();
                Assert.AreEqual("Plate", surface.name);
                Assert.AreEqual(0.25f, surface.Grating.Friction);
                Assert.AreSame(surface.Grating, context.Added.Values.Single());
            }
        }

        [Test]
        public void Files_whose_importer_attaches_tags_get_no_folder_of_gratings()
        {
            using (var files = new GltfFiles())
            {
                string path = files.Write("model.gltf", "Plate", GltfFiles.Tag(1000));
                Preprocess(path);
                AssetDatabase.Assets[path] = ByUnityGltf(GltfFiles.Tag(1000), null, null).transform.parent.gameObject;
                Postprocess(new[] { path }, new string[0]);
                Assert.That(!AssetDatabase.IsValidFolder(path + " Gratings"));
                AssetDatabase.Assets.Remove(path);
            }
        }

        /// <summary>A custom dependency of files with tags, and of no others.</summary>
        [Test]
        public void Files_with_tags_depend_on_the_packages_version_and_on_the_importers_it_has_a_part_for()
        {
            AssetDatabase.Dependencies.Clear();
            EditorApplication.Load(typeof(TagImporter).Assembly);
            Assert.AreEqual(Hash128.Compute(NativeMethods.Version), AssetDatabase.Dependencies[TagImporter.Dependency]);
            string file = Path.Combine(Environment.GetEnvironmentVariable("KNURL_TEST_FOLDER"), "newest/Knurl.Haptics.Editor.dll");
            Type both = Assembly.Load(File.ReadAllBytes(file)).GetType(typeof(TagImporter).FullName, true); // with both importers
            both.GetMethod("Register", BindingFlags.Static | BindingFlags.NonPublic).Invoke(null, null);
            Assert.AreEqual(Hash128.Compute(NativeMethods.Version + " UnityGLTF glTFast"), AssetDatabase.Dependencies[TagImporter.Dependency]);
            EditorApplication.delayCall = null;
            using (var files = new GltfFiles())
            {
                Preprocess(files.Write("bare.gltf", "Plate", ""));
                CollectionAssert.IsEmpty(context.Dependencies);
                Preprocess(files.Write("model.gltf", "Plate", GltfFiles.Tag(1000)));
                CollectionAssert.AreEqual(new[] { TagImporter.Dependency }, context.Dependencies);
            }
        }

        [Test]
        public void Tagged_files_that_were_there_before_the_package_are_imported_once()
        {
            EditorUserSettings.Values.Clear();
            AssetDatabase.Imported.Clear();
            using (var files = new GltfFiles())
            {
                string tagged = files.Write("model.gltf", "Plate", GltfFiles.Tag(1000)), bare = files.Write("bare.gltf", "Plate", "");
                AssetDatabase.Assets[tagged] = AssetDatabase.Assets[bare] = made = new GameObject("Plate");
                TagImporter.ImportOnce();
                TagImporter.ImportOnce();
                CollectionAssert.AreEqual(new[] { tagged }, AssetDatabase.Imported);
                AssetDatabase.Assets.Remove(tagged);
                AssetDatabase.Assets.Remove(bare);
            }
        }

        static void Postprocess(string[] imported, string[] deleted)
        {
            typeof(TagImporter).GetMethod("OnPostprocessAllAssets", BindingFlags.Static | BindingFlags.NonPublic)
                .Invoke(null, new object[] { imported, deleted, new string[0], new string[0] });
        }

        [Test]
        public void A_deleted_files_gratings_go_but_not_somebody_elses()
        {
            using (var files = new GltfFiles())
            {
                string path = files.Write("model.gltf", "Plate", GltfFiles.Tag(1000)), folder = path + " Gratings";
                TagImporter.Import(path);
                AssetDatabase.CreateAsset(ScriptableObject.CreateInstance<KnurlGrating>(), folder + "/Own.asset");
                Postprocess(new string[0], new[] { path });
                Assert.IsNull(GltfFiles.Grating(folder + "/Plate.asset"));
                Assert.IsNotNull(GltfFiles.Grating(folder + "/Own.asset"));
                AssetDatabase.DeleteAsset(folder + "/Own.asset");
                TagImporter.Import(path);
                Postprocess(new string[0], new[] { path });
                Assert.That(!AssetDatabase.IsValidFolder(folder));
            }
        }

        /// <summary>A user scales an instance unevenly before the menu adds its surfaces: the axis stays in the mesh's axes. It
        /// was 26.6 degrees off.</summary>
        [Test]
        public void The_scale_of_an_instance_does_not_turn_a_menu_placed_axis()
        {
            using (var files = new GltfFiles())
            {
                string path = files.Write("model.gltf", "Plate", "{\"knurl_axis\": [1, 1, 0], " + GltfFiles.Tag(1000).Substring(1));
                var imported = new GameObject("Plate");
                made = new GameObject("Plate", typeof(MeshFilter));
                made.transform.localScale = new Vector3(3f, 1f, 1f);
                PrefabUtility.Sources[made] = imported;
                TagImporter.Import(path);
                KnurlMenu.AddTaggedSurfaces(made, path);
                Vector3 axis = made.GetComponent<KnurlSurface>().Axis;
                Object.DestroyImmediate(imported);
                Assert.AreEqual(1f, Vector3.Dot(new Vector3(-1f, 1f, 0f).normalized, axis), 1e-6f, "the cosine of the angle");
            }
        }

        [Test]
        public void The_keys_are_the_schemas()
        {
            string schema = File.ReadAllText(Path.Combine(Environment.GetEnvironmentVariable("KNURL_TEST_ROOT"), "assets/knurl_extras.schema.json"));
            string[] keys = Regex.Matches(schema, "\"(knurl(?:_\\w+)?)\": \\{").Cast<Match>()
                .Select(match => match.Groups[1].Value).Distinct().ToArray();
            CollectionAssert.AreEqual(keys, TagDocument.Keys);
        }
    }
}
