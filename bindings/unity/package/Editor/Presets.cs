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
