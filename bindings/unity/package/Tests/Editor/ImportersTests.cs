// SPDX-License-Identifier: MIT
using System.Linq;
using Knurl.Editing;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    /// <summary>Tags find the objects of both importers through the menu's function.</summary>
    [TestFixture("UnityGLTF")]
    [TestFixture("glTFast")]
    public sealed class ImportersTests
    {
        readonly string importer;
        GltfFiles files;
        GameObject root;

        public ImportersTests(string importer)
        {
            this.importer = importer;
        }

        [SetUp]
        public void SetUp()
        {
            files = new GltfFiles();
        }

        [TearDown]
        public void TearDown()
        {
            Object.DestroyImmediate(root);
            files.Dispose();
        }

        static string Node(string name, int mesh, string more)
        {
            return "{'name': '" + name + "', 'mesh': " + mesh + more + "}";
        }

        static string Tagged(double frequency)
        {
            return ", 'extras': " + GltfFiles.Tag(frequency);
        }

        static string Mesh(string name)
        {
            return "{'name': '" + name + "', 'primitives': [" + GltfFiles.Primitive + "]}";
        }

        /// <summary>Writes model.gltf, imports it, and adds its surfaces.</summary>
        void Place(string roots, string nodes, string meshes, string materials = "")
        {
            string path = files.WriteText("model.gltf", GltfFiles.Text(roots, nodes, meshes, materials));
            TagImporter.Import(path);
            root = Importers.Import(importer, path);
            KnurlMenu.AddTaggedSurfaces(root, path);
        }

        /// <summary>The surfaces: "object mesh frequency" of each, in the hierarchy's order.</summary>
        string Felt()
        {
            return string.Join(", ", root.GetComponentsInChildren<KnurlSurface>(true).Select(surface => surface.name + " "
                + surface.GetComponent<MeshFilter>().sharedMesh.name + " " + surface.Grating.SpatialFrequency.x)
                .ToArray());
        }

        [Test]
        public void A_sole_root_is_found_though_it_is_named_after_the_file()
        {
            Place("0", Node("Plate", 0, Tagged(1000)), Mesh("Plane.001"));
            Assert.AreEqual("model Plane.001 1000", Felt());
        }

        [Test]
        public void Several_roots_are_found_by_their_names()
        {
            Place("0, 1, 2", Node("A", 0, Tagged(1000)) + ", " + Node("B", 1, "") + ", " + Node("C", 2, Tagged(500)),
                Mesh("Plane") + ", " + Mesh("Plane.001") + ", " + Mesh("Plane.002"));
            Assert.AreEqual("A Plane 1000, C Plane.002 500", Felt());
        }

        [Test]
        public void A_sole_root_that_has_children_is_found_by_its_mesh()
        {
            Place("0", Node("Base", 0, Tagged(1000) + ", 'children': [1, 2]") + ", " + Node("Lid", 1, Tagged(500)) + ", "
                + Node("Knob", 2, ""), Mesh("Plane") + ", " + Mesh("Plane.001") + ", " + Mesh("Plane.002"));
            Assert.AreEqual("model Plane 1000, Lid Plane.001 500", Felt());
        }

        [Test]
        public void An_empty_sole_root_leaves_its_children_their_names()
        {
            Place("0", "{'name': 'Empty', 'children': [1, 2]}, " + Node("A", 0, Tagged(1000)) + ", "
                + Node("B", 1, Tagged(500)), Mesh("Plane") + ", " + Mesh("Plane.001"));
            Assert.AreEqual("A Plane 1000, B Plane.001 500", Felt());
        }

        /// <summary>The file and its second node have the same name.</summary>
        [Test]
        public void A_root_that_has_anothers_name_does_not_take_its_tag()
        {
            Place("0", Node("Base", 0, Tagged(1000) + ", 'children': [1]") + ", " + Node("model", 1, Tagged(500)),
                Mesh("Plane") + ", " + Mesh("Plane.001"));
            Assert.AreEqual("model Plane 1000, model Plane.001 500", Felt());
        }

        [Test]
        public void Siblings_of_one_name_get_each_its_own()
        {
            Place("0, 1, 2", Node("A", 0, Tagged(1000)) + ", " + Node("A", 1, Tagged(500)) + ", "
                + Node("A", 2, Tagged(250)), Mesh("X") + ", " + Mesh("Y") + ", " + Mesh("Z"));
            string names = importer == "glTFast" ? "A X 1000, A_0 Y 500, A_1 Z 250" : "A X 1000, A Y 500, A Z 250";
            Assert.AreEqual(names, Felt());
        }

        [Test]
        public void A_node_without_a_name_is_found_by_its_mesh()
        {
            Place("0, 1", "{'mesh': 0" + Tagged(1000) + "}, " + Node("B", 1, ""), Mesh("Plane") + ", " + Mesh("Other"));
            Assert.AreEqual((importer == "glTFast" ? "Plane" : "GLTFNode0") + " Plane 1000", Felt());
        }

        [Test]
        public void One_tag_and_one_mesh_need_no_names_at_all()
        {
            Place("0", "{'mesh': 0" + Tagged(1000) + "}", "{'primitives': [" + GltfFiles.Primitive + "]}");
            Assert.AreEqual("model  1000", Felt());
        }

        /// <summary>glTFast makes one mesh per primitive, UnityGLTF one mesh of all, which is reported.</summary>
        [Test]
        public void A_primitives_tag_goes_to_what_shows_its_material()
        {
            string primitive = GltfFiles.Primitive.Substring(0, GltfFiles.Primitive.Length - 1) + ", 'material': ";
            string materials = "{'name': 'Wood'}, {'name': 'Steel', 'extras': " + GltfFiles.Tag(500) + "}";
            Place("0", Node("Plate", 0, ""), "{'name': 'Plane', 'primitives': [" + primitive + "0}, " + primitive
                + "1}]}", materials);
            Assert.AreEqual((importer == "glTFast" ? "Plane" : "model") + " Plane 500", Felt());
        }

        [Test]
        public void A_mesh_that_another_node_shows_is_left_alone()
        {
            string path = files.WriteText("model.gltf", GltfFiles.Text("0, 1", Node("A", 0, Tagged(1000)) + ", "
                + Node("B", 0, ""), Mesh("Plane")));
            TagImporter.Import(path);
            root = Importers.Import(importer, path);
            Object.DestroyImmediate(root.transform.Find("A").gameObject);
            GltfFiles.Felt("C", root.transform); // so that more than one mesh could match the tag
            LogAssert.Expect(LogType.Warning, new System.Text.RegularExpressions.Regex("'A' has no object"));
            KnurlMenu.AddTaggedSurfaces(root, path);
            Assert.AreEqual("", Felt());
        }

        [Test]
        public void What_is_not_there_is_told()
        {
            string path = files.WriteText("model.gltf", GltfFiles.Text("0, 1", Node("A", 0, Tagged(1000)) + ", "
                + Node("B", 0, Tagged(500)), Mesh("Plane")));
            TagImporter.Import(path);
            root = new GameObject("Something else");
            GltfFiles.Felt("C", root.transform);
            LogAssert.Expect(LogType.Warning, new System.Text.RegularExpressions.Regex("'A' has no object"));
            LogAssert.Expect(LogType.Warning, new System.Text.RegularExpressions.Regex("'B' has no object"));
            KnurlMenu.AddTaggedSurfaces(root, path);
            Assert.AreEqual("", Felt());
        }
    }
}
