// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using UnityEditor;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Knurl.Editing
{
    /// <summary>Knurl's entries in the editor's menus.</summary>
    internal static class KnurlMenu
    {
        const string Objects = "GameObject/Knurl/";
        const string NewDevice = Objects + "Haptic Device";
        const string NewCursor = Objects + "Haptic Cursor";
        const string AddSurface = Objects + "Add Surface To Selection";
        const string AddTagged = Objects + "Add Surfaces From glTF Tags";
        const string ReadTags = "Assets/Knurl/Read Tags";
        const int Priority = 10; // among the kinds of objects

        /// <summary>Creates a device, with its workspace around the selected surfaces if there are any.</summary>
        [MenuItem(NewDevice, false, Priority)]
        static void MakeDevice(MenuCommand command)
        {
            Vector3 middle;
            bool isAbout = Placing.FindSelectedSurfaces(out middle);
            var made = new GameObject("Haptic Device", typeof(KnurlDevice));
            Placing.Place(made, isAbout ? null : command.context as GameObject);
            if (isAbout)
            {
                made.transform.position = middle;
            }
        }

        /// <summary>Creates a ball that shows a device's position in the game.</summary>
        [MenuItem(NewCursor, false, Priority)]
        static void MakeCursor(MenuCommand command)
        {
            const float diameter = 0.004f; // m
            GameObject made = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            Object.DestroyImmediate(made.GetComponent<Collider>());
            made.name = "Haptic Cursor";
            made.transform.localScale = diameter * Vector3.one;
            made.AddComponent<KnurlCursor>();
            Placing.Place(made, command.context as GameObject);
        }

        [MenuItem(AddSurface, false, Priority + 1)]
        static void AddSurfaces()
        {
            foreach (GameObject owner in Selection.gameObjects.Where(CanBeFelt))
            {
                Undo.AddComponent<KnurlSurface>(owner);
            }
        }

        [MenuItem(AddSurface, true)]
        static bool CanAddSurfaces()
        {
            return Selection.gameObjects.Any(CanBeFelt);
        }

        static bool CanBeFelt(GameObject owner)
        {
            return owner.GetComponent<MeshFilter>() != null && owner.GetComponent<KnurlSurface>() == null;
        }

        [MenuItem(AddTagged, false, Priority + 2)]
        static void AddTaggedSurfaces()
        {
            GameObject root = Selection.activeGameObject;
            string path = FileOf(root);
            if (path == null)
            {
                return; // the user cancelled
            }
            int tags = TagImporter.Import(path);
            if (tags > 0)
            {
                AddTaggedSurfaces(root, path);
            }
            else if (tags == 0)
            {
                Debug.LogWarning("Knurl: " + path + " holds no tag", root);
            }
        }

        [MenuItem(AddTagged, true)]
        static bool CanAddTaggedSurfaces()
        {
            return Selection.activeGameObject != null && !EditorUtility.IsPersistent(Selection.activeGameObject);
        }

        internal static void AddTaggedSurfaces(GameObject root, string path)
        {
            IReadOnlyList<KnurlTag> tags = KnurlTags.Read(path);
            KnurlGrating[] gratings = TagAssets.PathsOf(path, tags.Select(tag => tag.Name))
                .Select(AssetDatabase.LoadAssetAtPath<KnurlGrating>).ToArray();
            Undo.IncrementCurrentGroup();
            Undo.SetCurrentGroupName("Add Knurl Surfaces");
            List<string> missed = TagSurfaces.Apply(root, tags, gratings);
            Undo.CollapseUndoOperations(Undo.GetCurrentGroup());
            foreach (string sentence in missed)
            {
                Debug.LogWarning("Knurl: " + path + ": " + sentence, root);
            }
        }

        /// <summary>The glTF file of an imported object, or one that the user chooses; null: cancelled.</summary>
        static string FileOf(GameObject root)
        {
            string path = PrefabUtility.GetPrefabAssetPathOfNearestInstanceRoot(root);
            if (!string.IsNullOrEmpty(path) && TagImporter.IsGltf(path))
            {
                return path;
            }
            string chosen = EditorUtility.OpenFilePanelWithFilters("The glTF file with the tags of " + root.name,
                "Assets", new[] { "glTF", "gltf,glb" });
            if (string.IsNullOrEmpty(chosen))
            {
                return null;
            }
            path = FileUtil.GetProjectRelativePath(chosen.Replace('\\', '/'));
            if (TagImporter.IsGltf(path))
            {
                return path;
            }
            Debug.LogWarning("Knurl: expected a .gltf or .glb file below the project's Assets, found " + chosen, root);
            return null;
        }

        [MenuItem("Help/Knurl Haptics")]
        static void OpenManual()
        {
            EditorUtility.OpenWithDefaultApp(Path.GetFullPath("Packages/com.knurl.haptics/Documentation~/com.knurl.haptics.md"));
        }

        [MenuItem(ReadTags, false, 1000)]
        static void ReadSelectedTags()
        {
            foreach (string path in SelectedFiles())
            {
                int tags = TagImporter.Import(path);
                if (tags >= 0)
                {
                    Debug.Log("Knurl: " + path + ": " + (tags == 0 ? "no tag" : tags + " tagged, gratings in "
                        + TagAssets.FolderOf(path)), AssetDatabase.LoadMainAssetAtPath(path));
                }
            }
        }

        [MenuItem(ReadTags, true)]
        static bool CanReadTags()
        {
            return SelectedFiles().Any();
        }

        static IEnumerable<string> SelectedFiles()
        {
            return Selection.assetGUIDs.Select(AssetDatabase.GUIDToAssetPath).Where(TagImporter.IsGltf);
        }
    }
}
