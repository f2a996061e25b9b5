// SPDX-License-Identifier: MIT
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using Knurl.Editing;
using NUnit.Framework;
using UnityEditor.AssetImporters;
using UnityEngine;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    /// <summary>Models with custom properties, in the types that Blender 3.4's FBX exporter gives them
    /// (export_fbx_bin.py: whole numbers, doubles, text; pairs of numbers as text). Unity's part, which reads the file and
    /// sends the message, is a stand-in after its reference.</summary>
    [TestFixture]
    public sealed class UserPropertyCases
    {
        static readonly string[] Names =
        {
            "knurl_spatial_frequency", "knurl_amplitude", "knurl_stiffness", "knurl_friction", "knurl_smooth", "note",
        };

        readonly AssetImportContext context = new AssetImportContext();
        UserProperties importer;

        [SetUp]
        public void SetUp()
        {
            context.Added.Clear();
            importer = new UserProperties { assetPath = "Assets/grip.fbx", context = context };
        }

        [TearDown]
        public void TearDown()
        {
            ImportedFile.End();
        }

        void Send(GameObject owner, string[] names, params object[] values)
        {
            typeof(UserProperties).GetMethod("OnPostprocessGameObjectWithUserProperties",
                BindingFlags.Instance | BindingFlags.NonPublic).Invoke(importer, new object[] { owner, names, values });
        }

        static GameObject Grip(bool hasMesh)
        {
            var owner = new GameObject("Grip \"left\"");
            if (hasMesh)
            {
                owner.AddComponent<MeshFilter>();
            }
            return owner;
        }

        [Test]
        public void An_objects_properties_become_a_surface_and_a_grating_of_the_file()
        {
            GameObject owner = Grip(true);
            Send(owner, Names, "[1000.0, 500.0]", 0.0002, 400f, 0.25f, 0, "by hand");
            var surface = owner.GetComponent<KnurlSurface>();
            Assert.AreEqual(new Vector2(1000f, 500f), surface.Grating.SpatialFrequency);
            Assert.AreEqual(0.0002f, surface.Grating.Amplitude);
            Assert.AreEqual(400f, surface.Grating.Stiffness);
            Assert.AreEqual(0.25f, surface.Grating.Friction);
            Assert.AreEqual(SurfaceSmoothness.Off, surface.Smooth);
            Assert.AreSame(surface.Grating, context.Added.Values.Single());
        }

        [Test]
        public void Two_objects_of_one_name_have_two_gratings()
        {
            foreach (int frequency in new[] { 1000, 500 })
            {
                Send(Grip(true), Names.Take(3).ToArray(), frequency, 0.0002, 400);
            }
            Assert.AreEqual(new[] { 1000f, 500f }, context.Added.Values.Cast<KnurlGrating>().Select(one => one.SpatialFrequency.x));
        }

        [Test]
        public void A_single_frequency_may_be_a_number()
        {
            GameObject owner = Grip(true);
            Send(owner, Names.Take(3).ToArray(), 1000, 0.0002, 400);
            Assert.AreEqual(new Vector2(1000f, 0f), owner.GetComponent<KnurlSurface>().Grating.SpatialFrequency);
        }

        [Test]
        public void A_wrong_value_is_a_warning_that_names_file_object_and_key()
        {
            GameObject owner = Grip(true);
            LogAssert.Expect(LogType.Warning, new Regex("Assets/grip.fbx: node 'Grip \"left\"'.*knurl_stiffness.*'hard'"));
            Send(owner, Names.Take(3).ToArray(), "[1000.0, 0.0]", 0.0002, "hard");
            Assert.That(owner.GetComponent<KnurlSurface>() == null);
            Assert.AreEqual(0, context.Added.Count);
        }

        [Test]
        public void A_missing_key_is_a_warning()
        {
            GameObject owner = Grip(true);
            LogAssert.Expect(LogType.Warning, new Regex("Grip.*amplitude: missing"));
            Send(owner, new[] { "knurl_spatial_frequency" }, 1000f);
            Assert.That(owner.GetComponent<KnurlSurface>() == null);
        }

        [Test]
        public void A_number_that_is_not_finite_is_a_warning_that_names_the_key([Values(float.NaN, float.PositiveInfinity)]
            float value)
        {
            GameObject owner = Grip(true);
            LogAssert.Expect(LogType.Warning, new Regex("Assets/grip.fbx: node 'Grip.*knurl_stiffness"));
            Send(owner, Names.Take(3).ToArray(), 1000, 0.0002, value);
            Assert.That(owner.GetComponent<KnurlSurface>() == null);
        }

        /// <summary>Not an error of JSON in a file that nobody has written.</summary>
        [TestCase("[1000.0, ]")]
        [TestCase("[1000.0, 0.0")]
        [TestCase("[1e999, 0]")]
        [TestCase("[--1, 0]")]
        [TestCase("[]")]
        public void A_malformed_list_is_a_warning_that_names_the_object_and_the_key(string list)
        {
            LogAssert.Expect(LogType.Warning, new Regex("Assets/grip.fbx: node 'Grip.*spatial_frequency"));
            Send(Grip(true), Names.Take(3).ToArray(), list, 0.0002, 400);
        }

        [Test]
        public void An_object_without_a_mesh_is_a_warning()
        {
            LogAssert.Expect(LogType.Warning, new Regex("has a tag but no MeshFilter"));
            Send(Grip(false), Names.Take(3).ToArray(), 1000, 0.0002, 400);
        }

        [Test]
        public void Other_properties_are_ignored()
        {
            GameObject owner = Grip(true);
            Send(owner, new[] { "note" }, "knurl_");
            Assert.That(owner.GetComponent<KnurlSurface>() == null);
        }
    }
}
