// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>A folder of the project with glTF files in it: a triangle of 0.1 m for each node.</summary>
    internal sealed class GltfFiles : IDisposable
    {
        internal const string Folder = "Assets/KnurlEditorTests";

        internal GltfFiles()
        {
            if (!AssetDatabase.IsValidFolder(Folder))
            {
                AssetDatabase.CreateFolder("Assets", Path.GetFileName(Folder));
            }
            Directory.CreateDirectory(Folder);
        }

        public void Dispose()
        {
            AssetDatabase.DeleteAsset(Folder);
            if (Directory.Exists(Folder))
            {
                Directory.Delete(Folder, true);
            }
        }

        /// <summary>Returns the path of a file with one node for each name, whose extras are "{...}" or "".</summary>
        internal string Write(string file, params string[] namesAndExtras)
        {
            return WriteText(file, Text(namesAndExtras));
        }

        internal static string Text(params string[] namesAndExtras)
        {
            var nodes = new List<string>();
            for (int i = 0; i < namesAndExtras.Length; i += 2)
            {
                string extras = namesAndExtras[i + 1] == "" ? "" : ", \"extras\": " + namesAndExtras[i + 1];
                nodes.Add("{\"name\": \"" + namesAndExtras[i] + "\", \"mesh\": 0" + extras + "}");
            }
            string all = string.Join(", ", Enumerable.Range(0, nodes.Count).Select(i => i.ToString()).ToArray());
            return Text(all, string.Join(", ", nodes.ToArray()), "{\"primitives\": [" + Primitive + "]}");
        }

        /// <summary>A triangle with UVs.</summary>
        internal const string Primitive = "{\"attributes\": {\"POSITION\": 0, \"TEXCOORD_0\": 1}}";

        /// <summary>A file of these parts: numbers of root nodes, nodes, meshes, materials, each without brackets and with
        /// ' for ".</summary>
        internal static string Text(string roots, string nodes, string meshes, string materials = "")
        {
            return ("{'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [" + roots + "]}], 'nodes': [" + nodes
                + "], 'meshes': [" + meshes + "], " + (materials == "" ? "" : "'materials': [" + materials + "], ")
                + "'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3', 'min': [0, 0, 0], "
                + "'max': [0.1, 0.1, 0]}, {'bufferView': 1, 'componentType': 5126, 'count': 3, 'type': 'VEC2'}"
                + "], 'bufferViews': [{'buffer': 0, 'byteLength': 36}, "
                + "{'buffer': 0, 'byteOffset': 36, 'byteLength': 24}], "
                + "'buffers': [{'byteLength': 60, 'uri': 'data:application/octet-stream;base64,BYTES'}]}")
                .Replace('\'', '"').Replace("BYTES", Convert.ToBase64String(Triangle()));
        }

        internal string WriteText(string file, string text)
        {
            string path = Folder + "/" + file;
            File.WriteAllText(path, text);
            return path;
        }

        static byte[] Triangle()
        {
            float[] numbers = { 0f, 0f, 0f, 0.1f, 0f, 0f, 0f, 0.1f, 0f, 0f, 1f, 1f, 1f, 0f, 0f };
            return numbers.SelectMany(BitConverter.GetBytes).ToArray();
        }

        /// <summary>A right tag. frequency: 1/m.</summary>
        internal static string Tag(double frequency)
        {
            return "{\"knurl_spatial_frequency\": " + frequency.ToString(CultureInfo.InvariantCulture)
                + ", \"knurl_amplitude\": 0.0002, \"knurl_stiffness\": 400, \"knurl_friction\": 0.25}";
        }

        internal static KnurlGrating Grating(string path)
        {
            return AssetDatabase.LoadAssetAtPath<KnurlGrating>(path);
        }

        internal static GameObject Felt(string name, Transform parent)
        {
            var made = new GameObject(name, typeof(MeshFilter));
            made.transform.SetParent(parent);
            return made;
        }
    }
}
