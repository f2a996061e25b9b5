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
        static readonly string[] Flags = { Prefix + "smooth" }; // Blender exports them as numbers

        /// <summary>A triangle for the tag to be of, which no file shows.</summary>
        const string Mesh = "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
            + "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
            + "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,"
            + "\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]";

        void OnPostprocessGameObjectWithUserProperties(GameObject owner, string[] names, object[] values)
        {
            string tag = TagOf(names, values);
            if (tag == null)
            {
                return;
            }
            try
            {
                Attach(owner, KnurlTags.ReadContent(Encoding.UTF8.GetBytes(Document(owner.name, tag)), assetPath)[0]);
            }
            catch (KnurlException exception)
            {
                LogWarning("Knurl: " + exception.Message);
            }
        }

        void Attach(GameObject owner, KnurlTag tag)
        {
            if (owner.GetComponent<MeshFilter>() == null)
            {
                LogWarning("Knurl: " + assetPath + ": '" + owner.name + "' has a tag but no mesh: tag the objects that "
                    + "have one");
                return;
            }
            var grating = ScriptableObject.CreateInstance<KnurlGrating>();
            grating.name = owner.name;
            tag.CopyTo(grating);
            context.AddObjectToAsset("Knurl " + Path(owner.transform), grating);
            var surface = owner.AddComponent<KnurlSurface>();
            surface.Grating = grating;
            surface.Smooth = tag.Smooth;
        }

        /// <summary>Names may repeat in a file, paths hardly do.</summary>
        static string Path(Transform of)
        {
            return of.parent == null ? of.name : Path(of.parent) + "/" + of.name;
        }

        /// <summary>The properties of a tag as members of a JSON object, or null if there is none.</summary>
        internal static string TagOf(IReadOnlyList<string> names, IReadOnlyList<object> values)
        {
            var members = new StringBuilder();
            for (int i = 0; i < names.Count; i++)
            {
                if (names[i].StartsWith(Prefix, StringComparison.Ordinal) && names[i] != AxisKey)
                {
                    bool isFlag = Array.IndexOf(Flags, names[i]) >= 0;
                    members.Append(members.Length == 0 ? "" : ",").Append(Quoted(names[i])).Append(':')
                        .Append(isFlag ? Flag(values[i]) : Json(values[i]));
                }
            }
            return members.Length == 0 ? null : members.ToString();
        }

        static string Document(string name, string tag)
        {
            return "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0,\"name\":" + Quoted(name) + ",\"extras\":{" + tag
                + "}}]," + Mesh + "}";
        }

        static string Flag(object value)
        {
            string text = Json(value);
            return text == "0" ? "false" : text == "1" ? "true" : text;
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
                return double.IsNaN(number) || double.IsInfinity(number) ? Quoted(digits) : digits; // JSON has no NaN
            }
            var text = value as string;
            return text != null && IsNumbers(text) ? text : Quoted(text ?? Convert.ToString(value, CultureInfo.InvariantCulture));
        }

        static bool IsNumbers(string text)
        {
            bool isList = text.Length > 2 && text[0] == '[' && text[text.Length - 1] == ']';
            foreach (char c in text)
            {
                isList &= c < 128 && (char.IsDigit(c) || "[]+-.,e ".IndexOf(c) >= 0);
            }
            return isList;
        }

        static string Quoted(string text)
        {
            var quoted = new StringBuilder("\"");
            foreach (char c in text)
            {
                quoted.Append(c == '"' || c == '\\' ? "\\" + c
                    : c < 32 ? "\\u" + ((int)c).ToString("x4", CultureInfo.InvariantCulture) : c.ToString());
            }
            return quoted.Append('"').ToString();
        }
    }
}
