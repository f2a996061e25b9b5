// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using System.IO;
using System.Linq;
using NUnit.Framework;

namespace Knurl.Tests
{
    /// <summary>KnurlTags finds the values in the demo assets' JSON.</summary>
    [TestFixture]
    public class AssetTests : Suite
    {
        [Test]
        public void EveryAssetsTagsAreRead()
        {
            string[] files = Directory.GetFiles(Path.Combine(Repository.Root, "assets"), "*.glb");
            Assert.That(files.Length, Is.GreaterThanOrEqualTo(3));
            foreach (string file in files)
            {
                List<Glb.Tagged> expected = new Glb(file).Surfaces();
                List<KnurlTag> found = KnurlTags.Read(file).ToList();
                Assert.That(expected.Count, Is.GreaterThan(0), file);
                Assert.AreEqual(expected.Count, found.Count, file);
                for (int i = 0; i < expected.Count; i++)
                {
                    Compare(expected[i], found[i], file);
                }
            }
        }

        static void Compare(Glb.Tagged expected, KnurlTag found, string file)
        {
            string what = file + ": " + expected.Name;
            Assert.AreEqual(expected.Name, found.Name, what);
            Assert.AreEqual(Glb.Frequency(expected.Tag), found.SpatialFrequency, what);
            Assert.AreEqual((float)Glb.Value(expected.Tag, "amplitude", -1.0), found.Amplitude, what);
            Assert.AreEqual((float)Glb.Value(expected.Tag, "stiffness", -1.0), found.Stiffness, what);
            Assert.AreEqual((float)Glb.Value(expected.Tag, "damping", 0.0), found.Damping, what);
            Assert.AreEqual((float)Glb.Value(expected.Tag, "friction", 0.0), found.Friction, what);
            Assert.AreEqual((float)Glb.Value(expected.Tag, "orientation", 0.0), found.Orientation, what);
            Assert.AreEqual(GratingMethod.Bandlimited, found.Method, what); // none of them sets a method
            Assert.AreEqual(expected.IsDoubleSided, found.DoubleSided, what);
        }

        [TestCase(100)]
        [TestCase(2000)]
        [TestCase(4000)]
        public void AFileThatWasCutOffIsTheLoadersSentence(int length)
        {
            string path = Path.Combine(Repository.Folder, "cut.glb");
            File.WriteAllBytes(path, File.ReadAllBytes(Repository.Asset("grid_2d.glb")).Take(length).ToArray());
            KnurlException e = Assert.Throws<KnurlException>(() => KnurlTags.Read(path));
            Contains(e.Message, "cut.glb");
            Assert.AreEqual(NativeMethods.KNURL_ERROR_FORMAT, e.Code);
        }
    }
}
