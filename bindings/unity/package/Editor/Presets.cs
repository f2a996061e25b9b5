// SPDX-License-Identifier: MIT
using System;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>The gratings that come with the package, as a drop-down button.</summary>
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

        /// <summary>What stands in the menu: "paper_0_5mm: 2000 /m, 0.27 mm, 700 N/m".</summary>
        internal static string Title(KnurlGrating preset)
        {
            return preset.name + ": " + Units.Frequency(preset.SpatialFrequency) + ", " +
                Units.Millimetres(preset.Amplitude) + ", " + Units.Number(preset.Stiffness) + " N/m";
        }

        /// <summary>Whether a grating is the package's: it cannot be edited, or would be changed for every project that has
        /// this package from the same disk.</summary>
        internal static bool IsPreset(KnurlGrating grating)
        {
            return grating != null
                && AssetDatabase.GetAssetPath(grating).StartsWith(Folder + "/", StringComparison.Ordinal);
        }

        /// <summary>A new asset of the project's own with a preset's numbers.</summary>
        internal static KnurlGrating Copy(KnurlGrating preset)
        {
            var made = ScriptableObject.CreateInstance<KnurlGrating>();
            EditorUtility.CopySerialized(preset, made);
            return Save(made, preset.name);
        }

        /// <summary>A new asset with the numbers that every grating begins with.</summary>
        internal static KnurlGrating New()
        {
            return Save(ScriptableObject.CreateInstance<KnurlGrating>(), "Grating");
        }

        static KnurlGrating Save(KnurlGrating made, string name)
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
            menu.ShowAsContext();
        }
    }
}
