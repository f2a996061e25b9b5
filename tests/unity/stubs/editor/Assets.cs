// Test-only stand-ins, never shipped. Assets are in memory; only files written by a test exist.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace UnityEditor
{
    /// Faithful: paths to objects and back, labels, folders that have to be made first, an asset's name is its file's.
    /// Not: import, files. An asset's GUID is its path.
    public static class AssetDatabase
    {
        static readonly Dictionary<UnityEngine.Object, string[]> labels = new Dictionary<UnityEngine.Object, string[]>();
        static readonly HashSet<string> folders = new HashSet<string> { "Assets" };

        public static readonly Dictionary<string, UnityEngine.Object> Assets =
            new Dictionary<string, UnityEngine.Object>();

        public static void CreateAsset(UnityEngine.Object asset, string path)
        {
            if (!IsValidFolder(ParentOf(path)))
            {
                throw new UnityException("Creating asset at path " + path + " failed.");
            }
            Assets[path] = asset;
            asset.name = System.IO.Path.GetFileNameWithoutExtension(path);
        }

        public static void SaveAssetIfDirty(UnityEngine.Object asset) { }
        public static bool WriteImportSettingsIfDirty(string path) { return true; }
        public static string GUIDToAssetPath(string guid) { return guid; }
        public static UnityEngine.Object LoadMainAssetAtPath(string path)
        {
            return LoadAssetAtPath<UnityEngine.Object>(path);
        }

        public static string[] GetLabels(UnityEngine.Object asset)
        {
            return labels.ContainsKey(asset) ? labels[asset] : new string[0];
        }

        public static void SetLabels(UnityEngine.Object asset, string[] given) { labels[asset] = given; }

        /// Only "t:Class", by the class alone, and "" for all.
        public static string[] FindAssets(string filter, string[] within)
        {
            List<string> found = new List<string>();
            foreach (KeyValuePair<string, UnityEngine.Object> pair in Assets)
            {
                bool inside = Array.Exists(within, folder => pair.Key.StartsWith(folder + "/", StringComparison.Ordinal));
                if (inside && (filter == "" || filter == "t:" + pair.Value.GetType().Name))
                {
                    found.Add(pair.Key);
                }
            }
            return found.ToArray();
        }

        public static string[] FindAssets(string filter)
        {
            return FindAssets(filter == "t:Prefab" ? "t:GameObject" : filter, new[] { "Assets" });
        }

        static string ParentOf(string path) { return path.Substring(0, path.LastIndexOf('/')); }

        /// An empty string, or the error.
        public static string MoveAsset(string from, string to)
        {
            if (!Assets.ContainsKey(from) && !folders.Contains(from))
            {
                return "Source asset path does not exist: " + from;
            }
            if (Assets.ContainsKey(to) || folders.Contains(to) || !folders.Contains(ParentOf(to)))
            {
                return "Destination path is taken or has no parent folder: " + to;
            }
            foreach (string path in new List<string>(Assets.Keys))
            {
                if (path == from || path.StartsWith(from + "/", StringComparison.Ordinal))
                {
                    UnityEngine.Object asset = Assets[path];
                    Assets.Remove(path);
                    Assets[to + path.Substring(from.Length)] = asset;
                }
            }
            foreach (string folder in new List<string>(folders))
            {
                if (folder == from || folder.StartsWith(from + "/", StringComparison.Ordinal))
                {
                    folders.Remove(folder);
                    folders.Add(to + folder.Substring(from.Length));
                }
            }
            return "";
        }

        /// Forgets everything.
        public static void Clear()
        {
            Assets.Clear();
            labels.Clear();
            AssetImporter.Importers.Clear();
            folders.Clear();
            folders.Add("Assets");
        }

        public static bool Contains(UnityEngine.Object asset) { return GetAssetPath(asset).Length > 0; }
        /// Including its content. Objects of deleted assets are destroyed.
        public static bool MoveAssetToTrash(string path) { return DeleteAsset(path); }

        public static bool DeleteAsset(string path)
        {
            bool found = folders.Remove(path);
            folders.RemoveWhere(folder => folder.StartsWith(path + "/", StringComparison.Ordinal));
            foreach (string asset in new List<string>(Assets.Keys))
            {
                if (asset == path || asset.StartsWith(path + "/", StringComparison.Ordinal))
                {
                    UnityEngine.Object.DestroyImmediate(Assets[asset], true);
                    Assets.Remove(asset);
                    found = true;
                }
            }
            return found;
        }

        public static void StartAssetEditing() { }
        public static void StopAssetEditing() { }
        public static readonly List<string> Imported = new List<string>();
        public static void ImportAsset(string path, ImportAssetOptions options) { Imported.Add(path); }
        public static string[] GetAllAssetPaths() { return System.Linq.Enumerable.ToArray(Assets.Keys); }
        public static bool IsAssetImportWorkerProcess() { return false; }

        /// Remembers the values; nothing is imported again because of them.
        public static readonly Dictionary<string, Hash128> Dependencies = new Dictionary<string, Hash128>();
        public static void RegisterCustomDependency(string dependency, Hash128 hashOfValue)
        {
            Dependencies[dependency] = hashOfValue;
        }

        public static bool IsValidFolder(string path) { return folders.Contains(path); }
        /// If the name is used, the folder's gets a number; without its parent none is made.
        public static string CreateFolder(string parent, string name)
        {
            if (!IsValidFolder(parent))
            {
                return "";
            }
            string made = parent + "/" + name;
            for (int i = 1; folders.Contains(made); i++)
            {
                made = parent + "/" + name + " " + i;
            }
            folders.Add(made);
            return made;
        }

        public static T LoadAssetAtPath<T>(string path) where T : UnityEngine.Object
        {
            UnityEngine.Object found;
            return Assets.TryGetValue(path, out found) ? found as T : null;
        }

        public static string GetAssetPath(UnityEngine.Object asset)
        {
            foreach (KeyValuePair<string, UnityEngine.Object> pair in Assets)
            {
                if (ReferenceEquals(pair.Value, asset))
                {
                    return pair.Key;
                }
            }
            return "";
        }

        public static string GenerateUniqueAssetPath(string path)
        {
            string made = path;
            for (int i = 1; Assets.ContainsKey(made); i++)
            {
                int dot = path.LastIndexOf('.');
                made = path.Substring(0, dot) + " " + i + path.Substring(dot);
            }
            return made;
        }
    }

    /// Default imports only what has changed.
    public enum ImportAssetOptions { Default, ForceUpdate }

    /// Of one project and user; a test clears it.
    public static class EditorUserSettings
    {
        public static readonly Dictionary<string, string> Values = new Dictionary<string, string>();
        public static string GetConfigValue(string name) { return Values.ContainsKey(name) ? Values[name] : null; }
        public static void SetConfigValue(string name, string value) { Values[name] = value; }
    }

    public class AssetImporter : UnityEngine.Object
    {
        /// The importer of a path, set by a test.
        public static readonly Dictionary<string, AssetImporter> Importers = new Dictionary<string, AssetImporter>();
        public int Reimports;
        public static AssetImporter GetAtPath(string path)
        {
            AssetImporter found;
            Importers.TryGetValue(path, out found);
            return found;
        }
        public void SaveAndReimport() { Reimports++; }
    }

    public class ModelImporter : AssetImporter
    {
        public bool isReadable { get; set; }
    }

    namespace AssetImporters
    {
        /// Remembers the objects that became part of the imported file, by their identifiers.
        public class AssetImportContext
        {
            public readonly Dictionary<string, UnityEngine.Object> Added = new Dictionary<string, UnityEngine.Object>();
            public void AddObjectToAsset(string identifier, UnityEngine.Object obj) { Added.Add(identifier, obj); }
            public readonly List<string> Dependencies = new List<string>();
            public void DependsOnCustomDependency(string dependency) { Dependencies.Add(dependency); }
            public void DependsOnArtifact(string path) { Dependencies.Add(path); }
        }
    }

    /// A test makes one and calls its methods.
    public class AssetPostprocessor
    {
        public AssetImporters.AssetImportContext context { get; set; }
        public string assetPath { get; set; }
        public virtual uint GetVersion() { return 0; }
        public virtual int GetPostprocessOrder() { return 0; }
    }
}
