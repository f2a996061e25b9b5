// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using NUnit.Framework;

namespace Knurl.Tests
{
    /// <summary>A native library that is missing, or not the package's own. Each time in a process of its own: a
    /// library that is loaded stays.</summary>
    [TestFixture]
    public class VersionTests : Suite
    {
        // The output of probe/Probe.cs with the library in `folder`.
        static List<string> Probe(string folder, string how = "")
        {
            string path = folder == null ? null : Path.Combine(Repository.Folder, folder);
            string probe = Path.Combine(Repository.Folder, "Probe.exe");
            var start = new ProcessStartInfo("timeout", "60 mono \"" + probe + "\" " + how)
            {
                UseShellExecute = false,
                RedirectStandardOutput = true,
                WorkingDirectory = Path.Combine(Repository.Folder, "empty")
            };
            if (path != null)
            {
                start.EnvironmentVariables["LD_LIBRARY_PATH"] = path;
            }
            using (Process process = Process.Start(start))
            {
                string output = process.StandardOutput.ReadToEnd();
                process.WaitForExit();
                Assert.AreEqual(0, process.ExitCode, output);
                var lines = new List<string>(output.TrimEnd().Split('\n'));
                Assert.AreEqual("end", lines.Last(), output);
                return lines;
            }
        }

        // Everything fails quietly, with the same sentence each time, and never once a frame.
        static void Fails(List<string> lines, params string[] parts)
        {
            string all = string.Join("\n", lines.ToArray());
            Assert.That(lines.Contains("started: False") && lines.Contains("again: False"), all);
            Assert.That(lines.Contains("file: -1") && lines.Contains("trace: none"), all);
            Assert.That(lines.Contains("running: False (0.00, 0.00, 0.00) 0") && lines.Contains("triangles: 0"), all);
            List<string> errors = lines.FindAll(l => l.StartsWith("log: Error"));
            Assert.That(errors.Count, Is.InRange(1, 6), all);
            Assert.That(lines.Exists(l => l.StartsWith("log: Exception")), Is.False, all);
            foreach (string line in errors.Concat(lines.Where(l => l.StartsWith("tags: "))))
            {
                Contains(line, parts);
            }
            Assert.That(lines.Exists(l => l.StartsWith("tags: ")), all);
            int logs = lines.Count(l => l.StartsWith("log: "));
            Assert.That(lines.Skip(lines.FindIndex(l => l.StartsWith("log: "))).Count(), Is.EqualTo(logs + 1),
                "a line each:\n" + all);
        }

        [Test]
        public void ThePackagesOwnLibraryIsTaken()
        {
            List<string> lines = Probe(null);
            Assert.That(lines.Contains("started: True") && lines.Contains("again: True"),
                string.Join("\n", lines.ToArray()));
        }

        [Test]
        public void AnotherInterfaceIsOneSentenceWithBothVersions()
        {
            Fails(Probe("stranger"), NativeMethods.Version, NativeMethods.Interface, "9.8.7", "0123456789abcdef");
        }

        [Test]
        public void AnotherInterfaceOfTheSameVersionIsRefusedAsWell()
        {
            Fails(Probe("twin"), NativeMethods.Version, NativeMethods.Interface, "0123456789abcdef");
        }

        [Test]
        public void ALibraryFromBeforeInterfacesIsOneSentenceWithBothVersions()
        {
            Fails(Probe("old"), NativeMethods.Version, "0.0.9");
        }

        /// <summary>On consoles, phones and pages.</summary>
        [TestCase("empty")]
        [TestCase("rubbish")]
        public void ABuiltGameWithoutALibraryGoesOnWithOneLine(string folder)
        {
            File.WriteAllText(Path.Combine(Repository.Folder, "rubbish", "libknurl_unity.so"), "rubbish");
            List<string> lines = Probe(folder, "game");
            Assert.AreEqual(2, lines.Count(line => line.StartsWith("told: ")), string.Join("\n", lines.ToArray()));
            string[] logs = lines.Where(line => line.StartsWith("log: ")).ToArray();
            Assert.AreEqual(1, logs.Length, string.Join("\n", logs));
            Contains(logs[0], "log: Log", "goes on without haptics");
        }

        [Test]
        public void NoLibraryIsOneSentence()
        {
            Fails(Probe("empty"), NativeMethods.Version, "knurl_unity");
        }

        [Test]
        public void AFileThatIsNoLibraryIsOneSentence()
        {
            File.WriteAllText(Path.Combine(Repository.Folder, "rubbish", "libknurl_unity.so"), "rubbish");
            Fails(Probe("rubbish"), NativeMethods.Version, "knurl_unity");
        }
    }
}
