// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Imitates the names that glTF importers produce, from their published sources (UnityGLTF 2.14, glTFast
    /// 6.14), for the tests' files: objects, meshes and materials without content. Both make the single root of a file
    /// the asset's main object, which Unity names after the file.</summary>
    internal sealed class Importers
    {
        [Serializable]
        internal sealed class Node
        {
            public string name = "";
            public int mesh = -1;
            public int[] children = new int[0];
        }

        [Serializable]
        internal sealed class Primitive
        {
            public int material = -1;
        }

        [Serializable]
        internal sealed class Named
        {
            public string name = "";
            public Primitive[] primitives = new Primitive[0];
        }

        [Serializable]
        internal sealed class Scene
        {
            public int[] nodes = new int[0];
        }

        [Serializable]
        internal sealed class Gltf
        {
            public Scene[] scenes = new Scene[0];
            public Node[] nodes = new Node[0];
            public Named[] meshes = new Named[0];
            public Named[] materials = new Named[0];
        }

        readonly Gltf file;

        Importers(string path)
        {
            file = JsonUtility.FromJson<Gltf>(File.ReadAllText(path));
        }

        /// <summary>An instance of the asset that an importer, "UnityGLTF" or "glTFast", makes of a .gltf
        /// file.</summary>
        internal static GameObject Import(string importer, string path)
        {
            var import = new Importers(path);
            GameObject main = importer == "glTFast" ? import.FastScene() : import.KhronosScene();
            main.name = Path.GetFileNameWithoutExtension(path); // as Unity does with every main object
            return main;
        }

        Material[] MaterialsOf(IEnumerable<Primitive> primitives)
        {
            return primitives.Select(primitive => new Material(Shader.Find("Standard"))
            {
                name = primitive.material < 0 ? "Default" : file.materials[primitive.material].name
            }).ToArray();
        }

        void Show(GameObject owner, int mesh, IEnumerable<Primitive> primitives)
        {
            owner.AddComponent<MeshFilter>().sharedMesh = new Mesh { name = file.meshes[mesh].name };
            owner.AddComponent<MeshRenderer>().sharedMaterials = MaterialsOf(primitives);
        }

        /// <summary>UnityGLTF: one object per node, with its whole mesh; removes the scene's object, and roots that
        /// have only one child.</summary>
        GameObject KhronosScene()
        {
            var main = new GameObject("Scene");
            foreach (int root in file.scenes[0].nodes)
            {
                KhronosNode(root).transform.SetParent(main.transform, false);
            }
            while (main.transform.childCount == 1 && main.GetComponents<Component>().Length == 1)
            {
                GameObject child = main.transform.GetChild(0).gameObject;
                child.transform.SetParent(null, false);
                UnityEngine.Object.DestroyImmediate(main);
                main = child;
            }
            return main;
        }

        GameObject KhronosNode(int index)
        {
            Node node = file.nodes[index];
            var made = new GameObject(node.name == "" ? "GLTFNode" + index : node.name);
            if (node.mesh >= 0)
            {
                Show(made, node.mesh, file.meshes[node.mesh].primitives);
            }
            foreach (int child in node.children)
            {
                KhronosNode(child).transform.SetParent(made.transform, false);
            }
            return made;
        }

        /// <summary>glTFast: the first primitive on the node's object, each further one on a child with the mesh's
        /// name; a node without a name gets its mesh's; siblings with equal names get _0, _1 and so on. The main object
        /// is a single root, otherwise the scene.</summary>
        GameObject FastScene()
        {
            int[] roots = file.scenes[0].nodes;
            var scene = new GameObject("Scene");
            var names = new HashSet<string>();
            GameObject[] made = roots.Select(root => FastNode(root, scene.transform, names)).ToArray();
            if (roots.Length != 1)
            {
                return scene;
            }
            made[0].transform.SetParent(null, false);
            UnityEngine.Object.DestroyImmediate(scene);
            return made[0];
        }

        GameObject FastNode(int index, Transform parent, HashSet<string> taken)
        {
            Node node = file.nodes[index];
            string mesh = node.mesh < 0 ? "" : file.meshes[node.mesh].name;
            string name = node.name != "" ? node.name : mesh != "" ? mesh : "Node-" + index;
            string unique = name;
            for (int i = 0; !taken.Add(unique); i++)
            {
                unique = name + "_" + i;
            }
            var made = new GameObject(unique);
            made.transform.SetParent(parent, false);
            for (int i = 0; node.mesh >= 0 && i < file.meshes[node.mesh].primitives.Length; i++)
            {
                GameObject owner = i == 0 ? made : new GameObject(mesh);
                if (i > 0)
                {
                    owner.transform.SetParent(made.transform, false);
                }
                Show(owner, node.mesh, file.meshes[node.mesh].primitives.Skip(i).Take(1));
            }
            var names = new HashSet<string>();
            foreach (int child in node.children)
            {
                FastNode(child, made.transform, names);
            }
            return made;
        }
    }
}
