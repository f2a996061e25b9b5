// SPDX-License-Identifier: MIT
using System;
using System.IO;

namespace Knurl.Tests
{
    /// <summary>Paths from run.sh.</summary>
    internal static class Repository
    {
        static string Variable(string name)
        {
            string value = Environment.GetEnvironmentVariable(name);
            if (string.IsNullOrEmpty(value))
            {
                throw new InvalidOperationException(name + " is not set: start these tests with tests/unity/run.sh");
            }
            return value;
        }

        internal static string Root
        {
            get { return Variable("KNURL_TEST_ROOT"); }
        }

        internal static string Folder
        {
            get { return Variable("KNURL_TEST_FOLDER"); }
        }

        internal static string Asset(string name)
        {
            return Path.Combine(Root, "assets", name);
        }

        internal static double[] Doubles(string name)
        {
            byte[] bytes = File.ReadAllBytes(Path.Combine(Folder, "traces", name));
            var values = new double[bytes.Length / sizeof(double)];
            Buffer.BlockCopy(bytes, 0, values, 0, bytes.Length);
            return values;
        }
    }
}
