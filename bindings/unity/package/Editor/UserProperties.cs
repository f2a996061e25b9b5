// Tags in the custom properties of FBX files. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Gives objects of a model file, such as .fbx or .blend, that have properties as
    /// knurl_spatial_frequency a KnurlSurface and a grating, which belong to the imported file. Knurl's own loader reads
    /// them: as a node of a glTF file that has the same tag.</summary>
    internal sealed class UserProperties : AssetPostprocessor
    {
        const string Prefix = "knurl_";
        const string AxisKey = Prefix + "axis"; // in axes that the exporter and the importer may have turned
        bool hasBegun; // the file, which all calls of one instance are for

        /// <summary>Raise it when files are to be imported again, because an import has other results.</summary>
        public override uint GetVersion()
        {
            return 1;
        }

        void OnPostprocessGameObjectWithUserProperties(GameObject owner, string[] names, object[] values)
        {
            string tag = TagOf(names, values);
            if (tag != null)
            {
                if (!hasBegun) // TagImporter ends it
                {
                    ImportedFile.Begin(assetPath, null, context.AddObjectToAsset);
                    hasBegun = true;
                }
                ImportedFile.Attach(owner, new[] { owner }, tag, null, null, false);
            }
        }

        /// <summary>The properties of a tag as a JSON object, or null if there is none.</summary>
        internal static string TagOf(IReadOnlyList<string> names, IReadOnlyList<object> values)
        {
            var members = new StringBuilder();
            for (int i = 0; i < names.Count; i++)
            {
                if (names[i].StartsWith(Prefix, StringComparison.Ordinal) && names[i] != AxisKey)
                {
                    members.Append(members.Length == 0 ? "{" : ",").Append(TagDocument.Quoted(names[i])).Append(':')
                        .Append(Json(values[i]));
                }
            }
            return members.Length == 0 ? null : members.Append('}').ToString();
        }

        /// <summary>Blender exports pairs of numbers as text: "[1000.0, 0.0]".</summary>
        static string Json(object value)
        {
            if (value is bool)
            {
                return (bool)value ? "true" : "false";
            }
            if (value is int || value is float || value is double)
            {
                double number = Convert.ToDouble(value, CultureInfo.InvariantCulture);
                string digits = Convert.ToString(value, CultureInfo.InvariantCulture);
                return double.IsNaN(number) || double.IsInfinity(number) ? TagDocument.Quoted(digits) : digits; // JSON has no NaN
            }
            var text = value as string;
            return List(text) ?? TagDocument.Quoted(text ?? Convert.ToString(value, CultureInfo.InvariantCulture));
        }

        /// <summary>The numbers of "[1000.0, 0.0]" as JSON; null for any other text, which the loader complains of by its
        /// key.</summary>
        static string List(string text)
        {
            if (text == null || text.Length < 2 || text[0] != '[' || text[text.Length - 1] != ']')
            {
                return null;
            }
            var numbers = new List<string>();
            foreach (string part in text.Substring(1, text.Length - 2).Split(','))
            {
                double number;
                if (!double.TryParse(part, NumberStyles.Float, CultureInfo.InvariantCulture, out number)
                    || double.IsNaN(number) || double.IsInfinity(number))
                {
                    return null;
                }
                numbers.Add(number.ToString("R", CultureInfo.InvariantCulture));
            }
            return "[" + string.Join(",", numbers.ToArray()) + "]";
        }
    }
}
