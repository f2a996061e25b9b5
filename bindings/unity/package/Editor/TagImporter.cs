// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Reads the tags of every new or changed .gltf and .glb file with Knurl's own loader. Importers that Knurl
    /// knows attach them to their objects while they import a file; otherwise they become gratings in a folder beside it,
    /// for a menu that attaches them. A wrong tag gives a warning that names file, object and key.</summary>
    internal sealed class TagImporter : AssetPostprocessor
    {
        /// <summary>Before the importer makes the objects.</summary>
        void OnPreprocessAsset()
        {
            ImportedFile.End();
            if (IsGltf(assetPath))
            {
                Dictionary<string, string> tags = null; // read once they are asked for
                string path = assetPath;
                ImportedFile.Begin(path, (array, index) =>
                {
                    string extras;
                    tags = tags ?? List(path);
                    return tags.TryGetValue(array + " " + index, out extras) ? extras : null;
                }, context.AddObjectToAsset);
            }
        }

        /// <summary>Empty without tags, or if the file is wrong: its importer tells that.</summary>
        static Dictionary<string, string> List(string path)
        {
            try
            {
                if (GltfText.MayHoldTags(path))
                {
                    return KnurlTags.List(File.ReadAllBytes(path), path);
                }
            }
            catch (KnurlException exception)
            {
                Debug.LogWarning("Knurl: " + exception.Message);
            }
            return new Dictionary<string, string>();
        }

        static void OnPostprocessAllAssets(string[] imported, string[] deleted, string[] moved, string[] movedFrom)
        {
            ImportedFile.End();
            foreach (string path in deleted)
            {
                if (IsGltf(path))
                {
                    TagAssets.Delete(path);
                }
            }
            for (int i = 0; i < moved.Length; i++)
            {
                if (IsGltf(moved[i]))
                {
                    TagAssets.Move(movedFrom[i], moved[i]);
                }
            }
            foreach (string path in imported)
            {
                if (IsGltf(path) && !IsAttached(path))
                {
                    Import(path);
                }
            }
        }

        /// <summary>True if the file's importer has attached its tags.</summary>
        static bool IsAttached(string path)
        {
            var main = AssetDatabase.LoadMainAssetAtPath(path) as GameObject;
            return main != null && main.GetComponentInChildren<KnurlSurface>(true) != null;
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
