// SPDX-License-Identifier: MIT
using System;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>The gratings that come with the package, and everyday materials, as a drop-down button.</summary>
    internal static class Presets
    {
        internal const string Folder = "Packages/com.knurl.haptics/Presets";
        internal const string Own = "Assets/Gratings";

        /// <summary>All of them, by name.</summary>
        internal static KnurlGrating[] Load()
        {
            return AssetDatabase.FindAssets("t:" + nameof(KnurlGrating), new[] { Folder })
                .Select(guid => AssetDatabase.LoadAssetAtPath<KnurlGrating>(AssetDatabase.GUIDToAssetPath(guid)))
                .Where(preset => preset != null)
                .OrderBy(preset => preset.name, StringComparer.Ordinal)
                .ToArray();
        }

        /// <summary>The text in the menu: "paper_0_5mm: 2000 /m, 0.27 mm, 700 N/m".</summary>
        internal static string Title(KnurlGrating preset)
        {
            return preset.name + ": " + Units.Frequency(preset.SpatialFrequency) + ", " +
                Units.Millimetres(preset.Amplitude) + ", " + Units.Number(preset.Stiffness) + " N/m";
        }

        /// <summary>With the source of its numbers: "Ruler: period 1 mm: its marks; depth 0.05 mm, a guess".</summary>
        internal static string Title(EverydayMaterial material)
        {
            return material.Title + ": period " + material.Period + "; depth " + material.Depth;
        }

        /// <summary>True if a grating belongs to the package: it cannot be edited, because that would change it for
        /// every project that uses the same copy of the package.</summary>
        internal static bool IsPreset(KnurlGrating grating)
        {
            return grating != null
                && AssetDatabase.GetAssetPath(grating).StartsWith(Folder + "/", StringComparison.Ordinal);
        }

        /// <summary>A new asset in the project with a preset's values.</summary>
        internal static KnurlGrating Copy(KnurlGrating preset)
        {
            var made = ScriptableObject.CreateInstance<KnurlGrating>();
            EditorUtility.CopySerialized(preset, made);
            return Save(made, preset.name);
        }

        /// <summary>A new asset with default values.</summary>
        internal static KnurlGrating New()
        {
            return Save(ScriptableObject.CreateInstance<KnurlGrating>(), "Grating");
        }

        /// <summary>Makes an asset of it, below Assets/Gratings.</summary>
        internal static T Save<T>(T made, string name) where T : ScriptableObject
        {
            if (!AssetDatabase.IsValidFolder(Own))
            {
                AssetDatabase.CreateFolder("Assets", Own.Substring("Assets/".Length));
            }
            AssetDatabase.CreateAsset(made, AssetDatabase.GenerateUniqueAssetPath(Own + "/" + name + ".asset"));
            EditorGUIUtility.PingObject(made);
            return made;
        }

        internal static void Draw(Action<KnurlGrating> chosen)
        {
            var label = new GUIContent("Preset", "Gratings that come with Knurl; the README says where their numbers " +
                "come from");
            if (!EditorGUILayout.DropdownButton(label, FocusType.Keyboard))
            {
                return;
            }
            var menu = new GenericMenu();
            foreach (KnurlGrating preset in Load())
            {
                menu.AddItem(new GUIContent(Title(preset).Replace('/', '\u2215')), false, () => chosen(preset));
            }
            foreach (EverydayMaterial material in EverydayMaterial.All)
            {
                menu.AddItem(new GUIContent("Everyday materials/" + Title(material).Replace('/', '\u2215')), false,
                    () => chosen(material.Make()));
            }
            menu.ShowAsContext();
        }
    }
}
