// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using System.Linq;
using GLTFast;
using GLTFast.Addons;
using UnityEngine;
#if KNURL_NEWTONSOFT
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
#endif

namespace Knurl.Importing
{
    /// <summary>An add-on of glTFast: objects whose node, mesh or material has a tag in its extras get a KnurlSurface. In
    /// the editor with every file; in games with files that GLTFast.Newtonsoft.GltfImport loads, because the other one drops
    /// extras.</summary>
    internal sealed class KnurlTagsAddon : ImportAddon<KnurlTagsAddon.Instance>
    {
        /// <summary>In the editor twice, because glTFast may forget its add-ons when play mode begins; an object gets one
        /// surface all the same.</summary>
#if UNITY_EDITOR
        [UnityEditor.InitializeOnLoadMethod]
#endif
        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.BeforeSceneLoad)]
        static void Register()
        {
            ImportAddonRegistry.RegisterImportAddon(new KnurlTagsAddon());
        }

        /// <summary>Of one file.</summary>
        internal sealed class Instance : ImportAddonInstance
        {
            GltfImportBase gltf;
            readonly Dictionary<GameObject, int> bare = new Dictionary<GameObject, int>(); // nodes without a mesh, their indices

            public override bool SupportsGltfExtension(string extensionName)
            {
                return false;
            }

            public override void Inject(GltfImportBase gltfImport)
            {
                gltf = gltfImport;
                gltfImport.AddImportAddonInstance(this);
            }

            public override void Inject(IInstantiator instantiator)
            {
                var objects = instantiator as GameObjectInstantiator;
                if (objects != null)
                {
                    objects.NodeCreated += (node, owner) => bare[owner] = (int)node;
                    objects.MeshAdded += (owner, node, name, mesh, joints, rootJoint, weights, number) =>
                    {
                        bare.Remove(owner);
                        Attach(owner, new[] { owner }, (int)node, mesh.meshIndex, mesh.materialIndices);
                    };
                    objects.EndSceneCompleted += AttachInstances;
                }
            }

            public override void Dispose()
            {
            }

            /// <summary>The objects feel like the first of the primitives' materials that is tagged.</summary>
            void Attach(GameObject named, IReadOnlyList<GameObject> owners, int node, int mesh, IReadOnlyList<int> materials)
            {
                bool isDone = false;
                for (int i = 0; i < materials.Count && !isDone; i++)
                {
                    int material = materials[i];
                    isDone = ImportedFile.Attach(named, owners, NodeExtras(node), MeshExtras(mesh), MaterialExtras(material),
                        material >= 0 && gltf.GetSourceMaterial(material).doubleSided);
                }
            }

            /// <summary>glTFast tells nothing of the objects that show a node's mesh many times (EXT_mesh_gpu_instancing): they
            /// are children of the node's object and no nodes themselves.</summary>
            void AttachInstances()
            {
                var read = gltf as IGltfReadable<GLTFast.Schema.RootBase>;
                foreach (KeyValuePair<GameObject, int> pair in bare)
                {
                    int mesh = read == null ? -1 : read.GetSourceRoot().Nodes[pair.Value].mesh;
                    GameObject[] shown = mesh < 0 ? new GameObject[0] : pair.Key.GetComponentsInChildren<MeshFilter>(true)
                        .Select(filter => filter.gameObject).Where(owner => IsInstance(owner, pair.Key)).ToArray();
                    if (shown.Length > 0)
                    {
                        Attach(pair.Key, shown, pair.Value, mesh,
                            read.GetSourceRoot().Meshes[mesh].Primitives.Select(each => each.material).ToArray());
                    }
                }
                bare.Clear();
            }

            bool IsInstance(GameObject owner, GameObject node)
            {
                return owner.transform.parent == node.transform && !bare.ContainsKey(owner) && owner.GetComponent<KnurlSurface>() == null;
            }

#if KNURL_NEWTONSOFT
            delegate bool Getter(string key, out JToken value);

            /// <summary>glTFast's extras can be asked for a key only.</summary>
            static string Text(Getter extras)
            {
                var members = new List<string>();
                foreach (string key in TagDocument.Keys)
                {
                    JToken value;
                    if (extras(key, out value))
                    {
                        members.Add(TagDocument.Quoted(key) + ":" + value.ToString(Formatting.None));
                    }
                }
                return "{" + string.Join(",", members.ToArray()) + "}";
            }

            string NodeExtras(int index)
            {
                var read = gltf as IGltfReadable<GLTFast.Newtonsoft.Schema.Root>;
                var node = read == null ? null : read.GetSourceRoot().Nodes[index] as GLTFast.Newtonsoft.Schema.Node;
                return node == null || node.extras == null ? ImportedFile.ExtrasOf("nodes", index)
                    : Text(node.extras.TryGetValue);
            }

            string MeshExtras(int index)
            {
                var read = gltf as IGltfReadable<GLTFast.Newtonsoft.Schema.Root>;
                var mesh = read == null ? null : read.GetSourceRoot().Meshes[index] as GLTFast.Newtonsoft.Schema.Mesh;
                return mesh == null || mesh.extras == null ? ImportedFile.ExtrasOf("meshes", index)
                    : Text(mesh.extras.TryGetValue);
            }

            string MaterialExtras(int index)
            {
                var material = index < 0 ? null : gltf.GetSourceMaterial(index) as GLTFast.Newtonsoft.Schema.Material;
                return material == null || material.extras == null ? ImportedFile.ExtrasOf("materials", index)
                    : Text(material.extras.TryGetValue);
            }
#else
            static string NodeExtras(int index)
            {
                return ImportedFile.ExtrasOf("nodes", index);
            }

            static string MeshExtras(int index)
            {
                return ImportedFile.ExtrasOf("meshes", index);
            }

            static string MaterialExtras(int index)
            {
                return ImportedFile.ExtrasOf("materials", index);
            }
#endif
        }
    }
}
