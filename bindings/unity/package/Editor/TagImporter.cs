// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Reads the tags of every .gltf and .glb file that comes into the project, or changes, by Knurl's own
    /// loader: it does not matter which glTF importer is installed, or whether any is. What is wrong with a tag is a
    /// warning that names file, object and key; what is right becomes gratings.</summary>
    internal sealed class TagImporter : AssetPostprocessor
    {
        static void OnPostprocessAllAssets(string[] imported, string[] deleted, string[] moved, string[] movedFrom)
        {
            for (int i = 0; i < moved.Length; i++)
            {
                if (IsGltf(moved[i]))
                {
                    TagAssets.Move(movedFrom[i], moved[i]);
                }
            }
            foreach (string path in imported)
            {
                if (IsGltf(path))
                {
                    Import(path);
                }
            }
        }

        /// <summary>Whether Knurl looks at an asset: packages cannot be written to.</summary>
        internal static bool IsGltf(string path)
        {
            return path.StartsWith("Assets/", StringComparison.Ordinal)
                && (path.EndsWith(".gltf", StringComparison.OrdinalIgnoreCase)
                    || path.EndsWith(".glb", StringComparison.OrdinalIgnoreCase));
        }

        /// <summary>One file. Never throws: other importers come after this one. Returns how many tags there were, or
        /// -1 after a warning.</summary>
        internal static int Import(string path)
        {
            try
            {
                if (!GltfText.MayHoldTags(path))
                {
                    return 0;
                }
                IReadOnlyList<KnurlTag> tags = KnurlTags.Read(path);
                foreach (string sentence in TagAssets.Write(path, tags))
                {
                    Warn(path, sentence);
                }
                return tags.Count;
            }
            catch (KnurlException exception)
            {
                Warn(path, exception.Message);
            }
            catch (IOException exception)
            {
                Warn(path, path + ": " + exception.Message);
            }
            catch (UnauthorizedAccessException exception)
            {
                Warn(path, path + ": " + exception.Message);
            }
            return -1;
        }

        static void Warn(string path, string sentence)
        {
            Debug.LogWarning("Knurl: " + sentence, AssetDatabase.LoadMainAssetAtPath(path));
        }
    }
}
