// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using UnityEngine;

namespace Knurl
{
    /// <summary>The names that a glTF file gives to its nodes and their meshes.</summary>
    internal sealed class GltfNames
    {
        // Filled in by JsonUtility.
        [Serializable]
        internal sealed class Node
        {
            public string name = "";
            public int mesh = -1;
        }

        [Serializable]
        internal sealed class Mesh
        {
            public string name = "";
        }

        [Serializable]
        internal sealed class Gltf
        {
            public Node[] nodes = new Node[0];
            public Mesh[] meshes = new Mesh[0];
        }

        readonly string file;
        readonly HashSet<string> nodes = new HashSet<string>();
        readonly Dictionary<string, HashSet<string>> meshes = new Dictionary<string, HashSet<string>>();

        /// <summary>json: of a file that KnurlTags.Read has accepted. path: the file's.</summary>
        internal GltfNames(string json, string path)
        {
            var gltf = JsonUtility.FromJson<Gltf>(json);
            file = Path.GetFileNameWithoutExtension(path);
            for (int i = 0; i < gltf.nodes.Length; i++)
            {
                Node node = gltf.nodes[i];
                bool shows = node.mesh >= 0 && node.mesh < gltf.meshes.Length;
                string mesh = shows ? gltf.meshes[node.mesh].name : "";
                nodes.Add(node.name);
                if (mesh != "")
                {
                    MeshesOf(node.name != "" ? node.name : mesh).Add(mesh); // named by its node, else its mesh
                }
            }
        }

        /// <summary>The meshes that the nodes of a name show; a mesh without a name is left out.</summary>
        internal HashSet<string> MeshesOf(string node)
        {
            HashSet<string> found;
            if (!meshes.TryGetValue(node, out found))
            {
                found = new HashSet<string>();
                meshes.Add(node, found);
            }
            return found;
        }

        /// <summary>True if a node has that name. The asset's main object has the file's name instead of its
        /// node's.</summary>
        internal bool IsNode(string name)
        {
            return name != file && nodes.Contains(name);
        }
    }
}
