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
        /// <summary>What files with tags depend on: they are imported again when it changes.</summary>
        internal const string Dependency = "com.knurl.haptics/tags";

        /// <summary>What the result of an import depends on besides the file: the package's version, and the importers that
        /// Knurl has a part for.</summary>
        const string Basis = NativeMethods.Version
#if KNURL_UNITYGLTF
            + " UnityGLTF"
#endif
#if KNURL_GLTFAST
            + " glTFast"
#endif
            ;

        /// <summary>At each start and after each compilation. Unity imports the files at its next refresh.</summary>
        [InitializeOnLoadMethod]
        static void Register()
        {
            if (!AssetDatabase.IsAssetImportWorkerProcess()) // a worker must not change dependencies
            {
                AssetDatabase.RegisterCustomDependency(Dependency, Hash128.Compute(Basis));
                EditorApplication.delayCall += ImportOnce;
            }
        }

        /// <summary>Files that were in the project before the package do not depend on it yet.</summary>
        internal static void ImportOnce()
        {
            if (!string.IsNullOrEmpty(EditorUserSettings.GetConfigValue(Dependency)))
            {
                return;
            }
            foreach (string path in AssetDatabase.GetAllAssetPaths())
            {
                if (IsGltf(path) && !AssetDatabase.IsValidFolder(TagAssets.FolderOf(path)) && MayHoldTags(path) && !IsAttached(path))
                {
                    AssetDatabase.ImportAsset(path, ImportAssetOptions.ForceUpdate);
                }
            }
            EditorUserSettings.SetConfigValue(Dependency, "imported");
        }

        /// <summary>Before the importer makes the objects.</summary>
        void OnPreprocessAsset()
        {
            ImportedFile.End();
            if (!IsGltf(assetPath) || !MayHoldTags(assetPath))
            {
                return;
            }
            Dictionary<string, string> tags = null; // read once they are asked for
            string path = assetPath;
            context.DependsOnCustomDependency(Dependency);
            ImportedFile.Begin(path, (array, index) =>
            {
                string extras;
                tags = tags ?? List(path);
                return tags.TryGetValue(array + " " + index, out extras) ? extras : null;
            }, context.AddObjectToAsset);
        }

        /// <summary>Empty if the file is wrong, after a warning.</summary>
        static Dictionary<string, string> List(string path)
        {
            var tags = new Dictionary<string, string>();
            Try(path, false, () => tags = KnurlTags.List(File.ReadAllBytes(path), path));
            return tags;
        }

        static bool MayHoldTags(string path)
        {
            bool may = false;
            Try(path, false, () => may = GltfText.MayHoldTags(path));
            return may;
        }

        /// <summary>Never throws, because other importers run after this one. isImported: the file's objects may be loaded, so
        /// that a click on the warning shows them. Returns false after a warning.</summary>
        static bool Try(string path, bool isImported, Action deed)
        {
            string shown = isImported ? path : null;
            try
            {
                deed();
                return true;
            }
            catch (KnurlException exception)
            {
                Warn(shown, exception.Message);
            }
            catch (IOException exception)
            {
                Warn(shown, path + ": " + exception.Message);
            }
            catch (UnauthorizedAccessException exception)
            {
                Warn(shown, path + ": " + exception.Message);
            }
            return false;
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

        /// <summary>Makes the gratings of one file. Returns the number of tags, or -1 after a warning.</summary>
        internal static int Import(string path)
        {
            int count = 0;
            bool isDone = Try(path, true, () =>
            {
                IReadOnlyList<KnurlTag> tags = GltfText.MayHoldTags(path) ? KnurlTags.Read(path) : new KnurlTag[0];
                TagAssets.Write(path, tags).ForEach(sentence => Warn(path, sentence));
                count = tags.Count;
            });
            return isDone ? count : -1;
        }

        /// <summary>shown: the file that a click shows, or null.</summary>
        static void Warn(string shown, string sentence)
        {
            Debug.LogWarning("Knurl: " + sentence, shown == null ? null : AssetDatabase.LoadMainAssetAtPath(shown));
        }
    }
}
