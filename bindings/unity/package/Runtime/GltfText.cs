// SPDX-License-Identifier: MIT
using System;
using System.IO;
using System.Text;

namespace Knurl
{
    /// <summary>The JSON of glTF files, and a quick search in it, so that those without tags are not loaded and cause no
    /// warnings about features that Knurl does not support, such as compressed meshes.</summary>
    internal static class GltfText
    {
        const uint Magic = 0x46546C67; // "glTF"
        const int HeaderBytes = 20; // of a .glb and of its first chunk, which is the JSON
        static readonly byte[] Word = { (byte)'k', (byte)'n', (byte)'u', (byte)'r', (byte)'l' };

        /// <summary>True if the file's JSON contains "knurl", which every tag does.</summary>
        internal static bool MayHoldTags(string path)
        {
            using (FileStream file = File.OpenRead(path))
            {
                return Holds(file, JsonLength(file));
            }
        }

        /// <summary>The file's JSON.</summary>
        internal static string ReadJson(string path)
        {
            using (FileStream file = File.OpenRead(path))
            {
                return ReadJson(file);
            }
        }

        internal static string ReadJson(Stream file)
        {
            long length = JsonLength(file); // before the JSON is read
            var bytes = new byte[Math.Min(length, file.Length - file.Position)];
            int count = 0, read = -1;
            while (count < bytes.Length && read != 0)
            {
                read = file.Read(bytes, count, bytes.Length - count);
                count += read;
            }
            return Encoding.UTF8.GetString(bytes, 0, count).TrimStart('\uFEFF');
        }

        /// <summary>Positions the file at the start of its JSON and returns the number of bytes to search.</summary>
        static long JsonLength(Stream file)
        {
            var header = new byte[HeaderBytes];
            int count = file.Read(header, 0, HeaderBytes);
            if (count == HeaderBytes && BitConverter.ToUInt32(header, 0) == Magic)
            {
                return BitConverter.ToUInt32(header, 12);
            }
            file.Position = 0;
            return file.Length;
        }

        static bool Holds(Stream stream, long length)
        {
            var block = new byte[65536];
            int matched = 0; // bytes of the word; its letters differ, so that the search restarts after a mismatch
            while (length > 0)
            {
                int count = stream.Read(block, 0, (int)Math.Min(length, block.Length));
                if (count <= 0)
                {
                    return false;
                }
                length -= count;
                for (int i = 0; i < count; i++)
                {
                    matched = block[i] == Word[matched] ? matched + 1 : block[i] == Word[0] ? 1 : 0;
                    if (matched == Word.Length)
                    {
                        return true;
                    }
                }
            }
            return false;
        }
    }
}
