// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using System.Linq;
using Knurl.Editing;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Knurl.Tests
{
    [TestFixture]
    public sealed class TagSurfacesTests
    {
        GltfFiles files;
        GameObject root;

        [SetUp]
        public void SetUp()
        {
            files = new GltfFiles();
            root = new GameObject("Model");
        }

        [TearDown]
        public void TearDown()
        {
            Object.DestroyImmediate(root);
            files.Dispose();
        }

        GameObject Felt(string name)
        {
            return GltfFiles.Felt(name, root.transform);
        }

        /// <summary>Reads and applies a file; returns the failures.</summary>
        List<string> Apply(params string[] namesAndExtras)
        {
            string path = files.Write("model.gltf", namesAndExtras);
            TagImporter.Import(path);
            IReadOnlyList<KnurlTag> tags = KnurlTags.Read(path);
            KnurlGrating[] gratings = TagAssets.PathsOf(path, tags.Select(tag => tag.Name)).Select(GltfFiles.Grating)
                .ToArray();
            return TagSurfaces.Apply(root, tags, gratings);
        }

        static float FrequencyOf(GameObject owner)
        {
            return owner.GetComponent<KnurlSurface>().Grating.SpatialFrequency.x;
        }

        [Test]
        public void Objects_of_the_same_names_get_surfaces_with_their_gratings()
        {
            GameObject a = Felt("A"), b = GltfFiles.Felt("B", Felt("Bare").transform);
            CollectionAssert.IsEmpty(Apply("A", GltfFiles.Tag(1000), "B", GltfFiles.Tag(500), "Bare", ""));
            Assert.AreEqual(1000f, FrequencyOf(a));
            Assert.AreEqual(500f, FrequencyOf(b));
            Assert.IsNull(b.transform.parent.GetComponent<KnurlSurface>());
        }

        [Test]
        public void A_surface_that_is_there_is_updated_and_keeps_its_axis()
        {
            GameObject a = Felt("A");
            var surface = a.AddComponent<KnurlSurface>();
            surface.Axis = Vector3.up;
            Apply("A", GltfFiles.Tag(1000));
            Assert.AreEqual(1, a.GetComponents<KnurlSurface>().Length);
            Assert.AreEqual(1000f, FrequencyOf(a));
            Assert.AreEqual(Vector3.up, surface.Axis);
        }

        /// <summary>The axis is in the mesh's axes, so it survives any scale of the node; x is mirrored.</summary>
        [Test]
        public void A_tags_axis_is_the_surfaces()
        {
            GameObject a = Felt("A");
            a.transform.localScale = new Vector3(2f, 1f, -3f);
            Apply("A\", \"scale\": [2, 1, -3], \"unused\": \"", "{\"knurl_axis\": [1, 2, 3], "
                + GltfFiles.Tag(1000).Substring(1));
            Vector3 axis = a.GetComponent<KnurlSurface>().Axis;
            Assert.AreEqual(0f, (new Vector3(-1f, 2f, 3f).normalized - axis).magnitude, 1e-6f);
        }

        [Test]
        public void Objects_that_share_a_name_take_its_tags_in_turn()
        {
            GameObject first = Felt("A"), second = Felt("A");
            CollectionAssert.IsEmpty(Apply("A", GltfFiles.Tag(1000), "A", GltfFiles.Tag(500)));
            Assert.AreEqual(1000f, FrequencyOf(first));
            Assert.AreEqual(500f, FrequencyOf(second));
        }

        [Test]
        public void A_tag_without_an_object_is_told()
        {
            Felt("B");
            Felt("C");
            List<string> missed = Apply("A", GltfFiles.Tag(1000));
            Assert.AreEqual(1, missed.Count);
            StringAssert.Contains("'A' has no object with a mesh of that name at or below 'Model'", missed[0]);
        }

        [Test]
        public void An_object_without_a_mesh_is_passed_over()
        {
            new GameObject("A").transform.SetParent(root.transform);
            Assert.AreEqual(1, Apply("A", GltfFiles.Tag(1000)).Count);
        }

        [Test]
        public void Two_tags_for_one_object_are_told_and_the_first_is_used()
        {
            GameObject only = Felt("A");
            List<string> missed = Apply("A", GltfFiles.Tag(1000), "A", GltfFiles.Tag(500));
            Assert.AreEqual(1000f, FrequencyOf(only));
            StringAssert.Contains("'A (2)' shares its object with 'A'", missed.Single());
        }

        [Test]
        public void A_name_that_ends_in_a_number_is_itself_first()
        {
            GameObject plain = Felt("A"), numbered = Felt("A (2)");
            Apply("A", GltfFiles.Tag(1000), "A (2)", GltfFiles.Tag(500));
            Assert.AreEqual(1000f, FrequencyOf(plain));
            Assert.AreEqual(500f, FrequencyOf(numbered));
        }

        [TestCase("A", "A")]
        [TestCase("A (2)", "A (2)|A_0|A")]
        [TestCase("A / Steel", "A / Steel|A")]
        [TestCase("A / Steel (2)", "A / Steel (2)|A / Steel_0|A / Steel|A")]
        [TestCase("A (x)", "A (x)")]
        [TestCase("(2)", "(2)")]
        public void What_a_tag_may_be_called(string name, string expected)
        {
            Assert.AreEqual(expected, string.Join("|", TagPlacer.Candidates(name).ToArray()));
        }
    }
}
