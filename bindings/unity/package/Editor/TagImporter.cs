// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Reads the tags of every new or changed .gltf and .glb file with Knurl's own loader, independently of
    /// any glTF importer. Tags become gratings; a wrong tag gives a warning that names file, object and key.</summary>
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

        /// <summary>True if Knurl imports an asset. Packages are read-only.</summary>
        internal static bool IsGltf(string path)
        {
            return path.StartsWith("Assets/", StringComparison.Ordinal)
                && (path.EndsWith(".gltf", StringComparison.OrdinalIgnoreCase)
                    || path.EndsWith(".glb", StringComparison.OrdinalIgnoreCase));
        }

        /// <summary>Imports one file. Never throws, because other importers run after this one. Returns the number of
        /// tags, or -1 after a warning.</summary>
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
