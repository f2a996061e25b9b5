// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Results of Knurl's loader for files that are written here.</summary>
    [TestFixture]
    public class TagTests : Suite
    {
        // One triangle with uvs; ' stands for ".
        const string Template = @"{
            'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0, 'name': 'Fläche'}],
            'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}, 'material': 0}]}],
            'materials': [{'name': 'm', 'doubleSided': DOUBLE, 'extras': {'knurl': TAG}}],
            'accessors': [
                {'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3', 'min': [0, 0, -0.1],
                    'max': [0.1, 0, 0]},
                {'bufferView': 1, 'componentType': 5126, 'count': 3, 'type': 'VEC2'}],
            'bufferViews': [{'buffer': 0, 'byteLength': 36}, {'buffer': 0, 'byteOffset': 36, 'byteLength': 24}],
            'buffers': [{'byteLength': 60, 'uri': 'data:application/octet-stream;base64,DATA'}]}";

        const string Plain = "{'version': 1, 'spatial_frequency': 800, 'amplitude': 0.0001, 'stiffness': 300}";

        string folder;

        [SetUp]
        public void MakeFolder()
        {
            folder = Path.Combine(Path.GetTempPath(), "knurl-" + Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(folder);
        }

        [TearDown]
        public void RemoveFolder()
        {
            Directory.Delete(folder, true);
        }

        string Write(string name, string tag, bool isDoubleSided = false)
        {
            var floats = new[] { 0f, 0f, 0f, 0.1f, 0f, 0f, 0f, 0f, -0.1f, 0f, 0f, 1f, 0f, 0f, 1f };
            var bytes = new byte[4 * floats.Length];
            Buffer.BlockCopy(floats, 0, bytes, 0, bytes.Length);
            string path = Path.Combine(folder, name);
            File.WriteAllText(path, Template.Replace("TAG", tag).Replace("DOUBLE", isDoubleSided ? "true" : "false")
                .Replace('\'', '"').Replace("DATA", Convert.ToBase64String(bytes)));
            return path;
        }

        [Test]
        public void AllKeysAreRead()
        {
            IReadOnlyList<KnurlTag> tags = KnurlTags.Read(Write("a.gltf", "{'version': 1, 'spatial_frequency': [500, 250],"
                + " 'amplitude': 0.0003, 'stiffness': 350, 'damping': 1.5, 'friction': 0.25, 'orientation': 0.5,"
                + " 'method': 'S1'}", true));
            Assert.AreEqual(1, tags.Count);
            KnurlTag tag = tags[0];
            Assert.AreEqual("Fläche", tag.Name);
            Assert.AreEqual(new Vector2(500f, 250f), tag.SpatialFrequency);
            Assert.AreEqual(0.0003f, tag.Amplitude);
            Assert.AreEqual(350f, tag.Stiffness);
            Assert.AreEqual(1.5f, tag.Damping);
            Assert.AreEqual(0.25f, tag.Friction);
            Assert.AreEqual(0.5f, tag.Orientation);
            Assert.AreEqual(GratingMethod.S1, tag.Method);
            Assert.That(tag.DoubleSided);
        }

        [Test]
        public void OneNumberIsAFrequencyAlongX()
        {
            string path = Write("ä b.gltf", Plain);
            KnurlTag tag = KnurlTags.Read(path)[0];
            Assert.AreEqual(new Vector2(800f, 0f), tag.SpatialFrequency);
            Assert.That(tag.DoubleSided, Is.False);
        }

        [Test]
        public void ATagFillsAGrating()
        {
            string path = Write("a.gltf", Plain);
            KnurlGrating grating = Made(ScriptableObject.CreateInstance<KnurlGrating>());
            KnurlTags.Read(path)[0].CopyTo(grating);
            Assert.AreEqual(new Vector2(800f, 0f), grating.SpatialFrequency);
            Assert.AreEqual(0.0001f, grating.Amplitude);
            Assert.AreEqual(300f, grating.Stiffness);
        }

        [TestCase("{'version': 1, 'spatial_frequency': 800, 'amplitude': 0.0001}", "stiffness")]
        [TestCase("{'version': 1, 'spatial_frequency': 800, 'amplitude': -1, 'stiffness': 300}", "amplitude")]
        [TestCase("{'version': 1, 'spatial_frequency': 800, 'amplitude': 0, 'stiffness': 300, 'stifness': 1}",
            "stifness")]
        [TestCase("{'version': 2, 'spatial_frequency': 800, 'amplitude': 0, 'stiffness': 300}", "version")]
        [TestCase("{'version': 1, 'spatial_frequency': 'much', 'amplitude': 0, 'stiffness': 300}",
            "spatial_frequency")]
        public void AWrongTagIsASentenceThatNamesFileAndKey(string tag, string key)
        {
            string path = Write("wrong.gltf", tag);
            KnurlException e = Assert.Throws<KnurlException>(() => KnurlTags.Read(path));
            Assert.AreEqual(NativeMethods.KNURL_ERROR_FORMAT, e.Code);
            Contains(e.Message, "wrong.gltf", key);
        }

        [Test]
        public void AFileThatIsNotThereIsASentence()
        {
            string path = Path.Combine(folder, "nothing.glb");
            KnurlException e = Assert.Throws<KnurlException>(() => KnurlTags.Read(path));
            Assert.AreEqual(NativeMethods.KNURL_ERROR_IO, e.Code);
            Contains(e.Message, "nothing.glb");
        }

        [TestCase("")]
        [TestCase("{\"asset\": {\"version\": \"2.0\"")]
        [TestCase("rubbish")]
        public void AFileThatIsNoGltfIsASentence(string text)
        {
            string path = Path.Combine(folder, "broken.gltf");
            File.WriteAllText(path, text);
            KnurlException e = Assert.Throws<KnurlException>(() => KnurlTags.Read(path));
            Assert.AreEqual(NativeMethods.KNURL_ERROR_FORMAT, e.Code);
            Contains(e.Message, "broken.gltf");
        }

        [Test]
        public void NoPathIsASentence()
        {
            Assert.Throws<KnurlException>(() => KnurlTags.Read(null));
            Assert.Throws<KnurlException>(() => KnurlTags.Read(""));
        }

        /// <summary>A game that loads a file by itself: the axis is in the mesh's axes, whatever the scale of the loaded
        /// objects and of what they are below.</summary>
        [Test]
        public void LoadedObjectsGetTheirSurfaces()
        {
            byte[] content = File.ReadAllBytes(Write("a.gltf", Plain.Replace("}", ", 'axis': [1, 0, 1]}")));
            IReadOnlyList<KnurlTag> tags = KnurlTags.Read(content, "a.gltf");
            Transform above = MakeObject("Above").transform;
            above.localScale = new Vector3(1f, 1f, 5f);
            GameObject root = MakeObject("Root"), loaded = MakeObject("Fläche"), other = MakeObject("Other");
            foreach (GameObject shown in new[] { loaded, other })
            {
                shown.transform.SetParent(root.transform, false);
                shown.AddComponent<MeshFilter>();
            }
            root.transform.SetParent(above, false);
            CollectionAssert.IsEmpty(KnurlTags.Apply(root, tags));
            var surface = loaded.GetComponent<KnurlSurface>();
            Assert.AreEqual(800f, surface.Grating.SpatialFrequency.x);
            Assert.AreEqual(1f, Vector3.Dot(new Vector3(-1f, 0f, 1f).normalized, surface.Axis), 1e-6f);
            Assert.That(other.GetComponent<KnurlSurface>() == null);
            KnurlTags.Apply(root, tags);
            Assert.AreEqual(1, loaded.GetComponents<KnurlSurface>().Length, "an object that has one is updated");
        }

        [Test]
        public void ATagWithoutAnObjectIsTold()
        {
            IReadOnlyList<string> missed = KnurlTags.Apply(MakeObject("Root"), KnurlTags.Read(Write("a.gltf", Plain)));
            Assert.AreEqual(1, missed.Count);
            StringAssert.Contains("'Fläche' has no object with a mesh of that name", missed[0]);
        }

        [Test]
        public void ANullIsNamed()
        {
            Assert.Throws<ArgumentNullException>(() => KnurlTags.Apply(null, KnurlTags.Read(Write("a.gltf", Plain))));
            Assert.Throws<ArgumentNullException>(() => KnurlTags.Apply(MakeObject("Root"), null));
            Assert.Throws<ArgumentNullException>(() => KnurlTags.Read(null, "a.gltf"));
        }
    }
}
