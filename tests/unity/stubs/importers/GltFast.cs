// Stands in for glTFast: declarations as in 6.19.0 (com.unity.cloud.gltfast: ImportAddon.cs, ImportAddonInstance.cs,
// ImportAddonRegistry.cs, GameObjectInstantiator.cs, IGltfReadable.cs, Newtonsoft/Schema), and of its loader the order of
// calls: add-ons into the import, then into the instantiator, then nodes and their meshes. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using Newtonsoft.Json.Linq;
using UnityEngine;

namespace GLTFast.Schema
{
    /// Instances: a test's, for the accessors of EXT_mesh_gpu_instancing.
    public abstract class NodeBase { public string name; public int mesh = -1; public int Instances; }
    public abstract class MeshPrimitiveBase { public int material = -1; }
    public class MeshPrimitive : MeshPrimitiveBase { }

    /// materials: a test's, of the primitives.
    public abstract class MeshBase
    {
        public string name;
        public int[] materials = new int[0];
        public IReadOnlyList<MeshPrimitiveBase> Primitives
        {
            get { return Array.ConvertAll(materials, each => new MeshPrimitive { material = each }); }
        }
    }

    public abstract class MaterialBase { public bool doubleSided; }

    public abstract class RootBase
    {
        public abstract IReadOnlyList<NodeBase> Nodes { get; }
        public abstract IReadOnlyList<MeshBase> Meshes { get; }
        public abstract IReadOnlyList<MaterialBase> Materials { get; }
    }

    // Of Unity's JSON reader, which drops extras.
    public class Node : NodeBase { }
    public class Mesh : MeshBase { }
    public class Material : MaterialBase { }

    public class Root : RootBase
    {
        public Node[] nodes = new Node[0];
        public Mesh[] meshes = new Mesh[0];
        public Material[] materials = new Material[0];
        public override IReadOnlyList<NodeBase> Nodes { get { return nodes; } }
        public override IReadOnlyList<MeshBase> Meshes { get { return meshes; } }
        public override IReadOnlyList<MaterialBase> Materials { get { return materials; } }
    }
}

namespace GLTFast.Newtonsoft.Schema
{
    using GLTFast.Schema;

    public class UnclassifiedData
    {
        public readonly Dictionary<string, string> Json = new Dictionary<string, string>();

        public bool TryGetValue<T>(string key, out T value)
        {
            string json;
            bool found = Json.TryGetValue(key, out json);
            value = found ? (T)(object)new JToken(json) : default(T);
            return found;
        }
    }

    public class MeshExtras : UnclassifiedData { }
    public class Node : NodeBase { public UnclassifiedData extras; }
    public class Mesh : MeshBase { public MeshExtras extras; }
    public class Material : MaterialBase { public UnclassifiedData extras; }

    public class Root : RootBase
    {
        public Node[] nodes = new Node[0];
        public Mesh[] meshes = new Mesh[0];
        public Material[] materials = new Material[0];
        public override IReadOnlyList<NodeBase> Nodes { get { return nodes; } }
        public override IReadOnlyList<MeshBase> Meshes { get { return meshes; } }
        public override IReadOnlyList<MaterialBase> Materials { get { return materials; } }
    }
}

namespace GLTFast.Addons
{
    public abstract class ImportAddonInstance : IDisposable
    {
        public abstract bool SupportsGltfExtension(string extensionName);
        public abstract void Inject(GltfImportBase gltfImport);
        public abstract void Inject(IInstantiator instantiator);
        public abstract void Dispose();
    }

    public abstract class ImportAddon { public abstract void CreateImportInstance(GltfImportBase gltfImport); }

    public abstract class ImportAddon<TInstance> : ImportAddon where TInstance : ImportAddonInstance, new()
    {
        public override void CreateImportInstance(GltfImportBase gltfImport) { new TInstance().Inject(gltfImport); }
    }

    public static class ImportAddonRegistry
    {
        static readonly List<ImportAddon> addons = new List<ImportAddon>();
        public static void RegisterImportAddon(ImportAddon addon) { addons.Add(addon); }
        internal static void InjectAllAddons(GltfImportBase gltfImport)
        {
            addons.ForEach(addon => addon.CreateImportInstance(gltfImport));
        }
    }
}

namespace GLTFast
{
    using GLTFast.Addons;
    using GLTFast.Schema;

    public interface IGltfReadable { MaterialBase GetSourceMaterial(int index = 0); }
    public interface IGltfReadable<out TRoot> : IGltfReadable where TRoot : RootBase { TRoot GetSourceRoot(); }
    public interface IInstantiator { }

    public struct MeshResult
    {
        public int meshIndex;
        public int[] materialIndices;
        public UnityEngine.Mesh mesh;
    }

    public class GameObjectInstantiator : IInstantiator
    {
        public delegate void MeshAddedDelegate(GameObject gameObject, uint nodeIndex, string meshName, MeshResult meshResult,
            uint[] joints = null, uint? rootJoint = null, float[] morphTargetWeights = null, int meshNumeration = 0);

        public delegate void NodeCreatedDelegate(uint nodeIndex, GameObject gameObject);

        public event NodeCreatedDelegate NodeCreated;
        public event MeshAddedDelegate MeshAdded;
        public event Action EndSceneCompleted;

        internal void End()
        {
            if (EndSceneCompleted != null)
            {
                EndSceneCompleted();
            }
        }

        /// A stand-in for CreateNode, SetNodeName, AddPrimitive and AddPrimitiveInstanced.
        internal void Add(Transform scene, uint index, NodeBase node, MeshBase mesh)
        {
            var made = new GameObject(node.name);
            made.transform.SetParent(scene, false);
            if (NodeCreated != null)
            {
                NodeCreated(index, made);
            }
            for (int i = 0; i < node.Instances; i++)
            {
                var shown = new GameObject(mesh.name + "_i" + i);
                shown.transform.SetParent(made.transform, false);
                shown.AddComponent<MeshFilter>().sharedMesh = new UnityEngine.Mesh { name = mesh.name };
            }
            for (int i = 0; mesh != null && node.Instances == 0 && i < mesh.materials.Length; i++)
            {
                GameObject owner = i == 0 ? made : new GameObject(mesh.name);
                if (i > 0)
                {
                    owner.transform.SetParent(made.transform, false);
                }
                var result = new MeshResult { meshIndex = node.mesh, materialIndices = new[] { mesh.materials[i] } };
                owner.AddComponent<MeshFilter>().sharedMesh = new UnityEngine.Mesh { name = mesh.name };
                if (MeshAdded != null)
                {
                    MeshAdded(owner, index, mesh.name, result, null, null, null, i);
                }
            }
        }
    }

    public abstract class GltfImportBase : IGltfReadable
    {
        readonly List<ImportAddonInstance> instances = new List<ImportAddonInstance>();
        protected GltfImportBase() { ImportAddonRegistry.InjectAllAddons(this); }
        public void AddImportAddonInstance<T>(T importInstance) where T : ImportAddonInstance { instances.Add(importInstance); }
        public MaterialBase GetSourceMaterial(int index = 0) { return Source.Materials[index]; }
        protected abstract RootBase Source { get; }

        /// A stand-in for InstantiateMainSceneAsync.
        public GameObject Instantiate()
        {
            var scene = new GameObject("Scene");
            var instantiator = new GameObjectInstantiator();
            instances.ForEach(instance => instance.Inject(instantiator));
            for (int i = 0; i < Source.Nodes.Count; i++)
            {
                NodeBase node = Source.Nodes[i];
                instantiator.Add(scene.transform, (uint)i, node, node.mesh < 0 ? null : Source.Meshes[node.mesh]);
            }
            instantiator.End();
            return scene;
        }
    }

    /// A stand-in for GltfImport of both readers: the root is given.
    public class GltfImportBase<TRoot> : GltfImportBase, IGltfReadable<TRoot> where TRoot : RootBase
    {
        readonly TRoot root;
        public GltfImportBase(TRoot root) { this.root = root; }
        public TRoot GetSourceRoot() { return root; }
        protected override RootBase Source { get { return root; } }
    }
}
