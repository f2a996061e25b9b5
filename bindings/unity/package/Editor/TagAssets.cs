// Gratings as assets: one for each tagged surface of a glTF file, in a folder beside it. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Knurl.Editing
{
    /// <summary>Grating assets of a glTF file's tags. Assets made by Knurl have a label, and only those are
    /// changed.</summary>
    internal static class TagAssets
    {
        /// <summary>Marks assets that were made from a tag; assets without it belong to the user.</summary>
        internal const string Label = "KnurlTag";

        const int LongestName = 80; // characters; Windows has trouble with long paths
        const string Invalid = "<>:\"/\\|?*[]";
        static readonly string[] Reserved =
        {
            "con", "prn", "aux", "nul", "com1", "com2", "com3", "com4", "com5", "com6", "com7", "com8", "com9", "lpt1",
            "lpt2", "lpt3", "lpt4", "lpt5", "lpt6", "lpt7", "lpt8", "lpt9", "cvs",
        };

        /// <summary>The folder of a file's gratings: "Assets/Models/plate.glb Gratings".</summary>
        internal static string FolderOf(string gltf)
        {
            return gltf + " Gratings";
        }

        /// <summary>The path of each surface's grating: valid on every file system, and unique even if case is
        /// ignored.</summary>
        internal static string[] PathsOf(string gltf, IEnumerable<string> surfaces)
        {
            var taken = new HashSet<string>(StringComparer.OrdinalIgnoreCase);
            return surfaces.Select(name => FolderOf(gltf) + "/" + Unique(Sanitise(name), taken) + ".asset").ToArray();
        }

        internal static string Sanitise(string name)
        {
            var clean = new StringBuilder(name.Length);
            foreach (char c in name)
            {
                clean.Append(char.IsControl(c) || char.IsSurrogate(c) || Invalid.IndexOf(c) >= 0 ? '_' : c);
            }
            string cut = clean.Length > LongestName ? clean.ToString(0, LongestName) : clean.ToString();
            cut = cut.Trim().TrimStart('.').TrimEnd('.', '~', ' '); // Unity ignores .x and x~
            bool reserved = Array.IndexOf(Reserved, cut.Split('.')[0].TrimEnd().ToLowerInvariant()) >= 0;
            return cut.Length == 0 ? "surface" : reserved ? "_" + cut : cut;
        }

        static string Unique(string name, HashSet<string> taken)
        {
            string candidate = name;
            for (int i = 2; !taken.Add(candidate); i++)
            {
                candidate = name + " (" + i + ")";
            }
            return candidate;
        }

        /// <summary>Makes or updates the grating of each tag. Returns the failures, one sentence each.</summary>
        internal static List<string> Write(string gltf, IReadOnlyList<KnurlTag> tags)
        {
            var refused = new List<string>();
            if (tags.Count == 0)
            {
                return refused;
            }
            string[] paths = PathsOf(gltf, tags.Select(tag => tag.Name));
            MakeFolder(FolderOf(gltf));
            var made = new List<string>();
            AssetDatabase.StartAssetEditing();
            try
            {
                for (int i = 0; i < tags.Count; i++)
                {
                    WriteOne(paths[i], tags[i], made, refused);
                }
            }
            finally
            {
                AssetDatabase.StopAssetEditing();
            }
            foreach (string path in made)
            {
                AssetDatabase.SetLabels(AssetDatabase.LoadMainAssetAtPath(path), new[] { Label });
                AssetDatabase.WriteImportSettingsIfDirty(path); // labels are in the meta
            }
            return refused;
        }

        static void WriteOne(string path, KnurlTag tag, List<string> made, List<string> refused)
        {
            Object found = AssetDatabase.LoadMainAssetAtPath(path);
            if (found == null && !File.Exists(path))
            {
                var grating = ScriptableObject.CreateInstance<KnurlGrating>();
                Put(tag, grating);
                AssetDatabase.CreateAsset(grating, path);
                made.Add(path);
                return;
            }
            var known = found as KnurlGrating;
            if (known == null || !AssetDatabase.GetLabels(known).Contains(Label))
            {
                refused.Add(path + " was not made of a tag (it lacks the label " + Label + ") and stays as it is: the "
                    + "tag of '" + tag.Name + "' is not used");
                return;
            }
            if (Put(tag, known))
            {
                EditorUtility.SetDirty(known);
                AssetDatabase.SaveAssetIfDirty(known);
            }
        }

        /// <summary>Returns true if it changed anything.</summary>
        internal static bool Put(KnurlTag tag, KnurlGrating grating)
        {
            bool same = grating.SpatialFrequency == tag.SpatialFrequency && grating.Amplitude == tag.Amplitude
                && grating.Stiffness == tag.Stiffness && grating.Damping == tag.Damping
                && grating.Friction == tag.Friction && grating.Orientation == tag.Orientation
                && grating.Method == tag.Method;
            if (!same)
            {
                tag.CopyTo(grating);
            }
            return !same;
        }

        static void MakeFolder(string folder)
        {
            if (!AssetDatabase.IsValidFolder(folder))
            {
                int slash = folder.LastIndexOf('/');
                AssetDatabase.CreateFolder(folder.Substring(0, slash), folder.Substring(slash + 1));
            }
        }

        /// <summary>Deletes the gratings of a deleted file, and their folder unless it holds something else.</summary>
        internal static void Delete(string gltf)
        {
            string folder = FolderOf(gltf);
            if (AssetDatabase.IsValidFolder(folder))
            {
                string[] all = AssetDatabase.FindAssets("", new[] { folder }).Select(AssetDatabase.GUIDToAssetPath).ToArray();
                string[] own = all.Where(IsOwn).ToArray();
                foreach (string path in own.Length == all.Length ? new[] { folder } : own)
                {
                    AssetDatabase.MoveAssetToTrash(path);
                }
            }
        }

        static bool IsOwn(string path)
        {
            Object asset = AssetDatabase.LoadMainAssetAtPath(path); // null if it is damaged
            return asset != null && AssetDatabase.GetLabels(asset).Contains(Label);
        }

        /// <summary>Moves the gratings along with a moved or renamed file; references to them stay valid.</summary>
        internal static void Move(string from, string to)
        {
            if (AssetDatabase.IsValidFolder(FolderOf(from)) && !AssetDatabase.IsValidFolder(FolderOf(to)))
            {
                string wrong = AssetDatabase.MoveAsset(FolderOf(from), FolderOf(to));
                if (!string.IsNullOrEmpty(wrong))
                {
                    Debug.LogWarning("Knurl: " + FolderOf(from) + " could not be moved along with its file: " + wrong);
                }
            }
        }
    }
}
