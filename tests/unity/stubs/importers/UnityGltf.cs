// Stands in for UnityGLTF: declarations as in 2.16.0-pre (github.com/KhronosGroup/UnityGLTF: GltfPlugin.cs,
// GltfImportPlugin.cs, ImportContext.cs, GLTFProperty.cs, GLTFMesh.cs), and of its importer the order that
// GLTFSceneImporter.GetNode has: an object with its mesh, then the plugins. SPDX-License-Identifier: MIT
using System.Collections.Generic;
using Newtonsoft.Json.Linq;
using UnityEngine;

namespace GLTF.Schema
{
    public class GLTFProperty { public JToken Extras; }
    public class GLTFMaterial : GLTFProperty { public string Name; public bool DoubleSided; }
    public class MeshPrimitive : GLTFProperty { public MaterialId Material; }
    public class GLTFMesh : GLTFProperty { public string Name; public List<MeshPrimitive> Primitives; }
    /// Instances: a test's, for the accessors of EXT_mesh_gpu_instancing.
    public class Node : GLTFProperty { public string Name; public MeshId Mesh; public int Instances; }

    public class GLTFRoot
    {
        public List<Node> Nodes = new List<Node>();
        public List<GLTFMesh> Meshes = new List<GLTFMesh>();
        public List<GLTFMaterial> Materials = new List<GLTFMaterial>();
    }

    public abstract class GLTFId<T>
    {
        public int Id;
        public GLTFRoot Root;
        public abstract T Value { get; }
    }

    public class MeshId : GLTFId<GLTFMesh> { public override GLTFMesh Value { get { return Root.Meshes[Id]; } } }
    public class MaterialId : GLTFId<GLTFMaterial> { public override GLTFMaterial Value { get { return Root.Materials[Id]; } } }
}

namespace UnityGLTF.Plugins
{
    using GLTF.Schema;

    public abstract class GLTFPlugin : ScriptableObject
    {
        public abstract string DisplayName { get; }
        public virtual string Description { get { return null; } }
        public virtual bool EnabledByDefault { get { return true; } }
    }

    public abstract class GLTFImportPlugin : GLTFPlugin
    {
        public abstract GLTFImportPluginContext CreateInstance(GLTFImportContext context);
    }

    public abstract class GLTFImportPluginContext
    {
        public virtual void OnAfterImportNode(Node node, int nodeIndex, GameObject nodeObject) { }
    }

    public class GLTFImportContext
    {
        public readonly List<GLTFImportPluginContext> Plugins = new List<GLTFImportPluginContext>();

        /// A stand-in for GLTFSceneImporter.
        public GameObject Import(GLTFRoot root)
        {
            var scene = new GameObject("Scene");
            for (int i = 0; i < root.Nodes.Count; i++)
            {
                Node node = root.Nodes[i];
                var made = new GameObject(node.Name);
                made.transform.SetParent(scene.transform, false);
                if (node.Mesh != null && node.Instances == 0)
                {
                    made.AddComponent<MeshFilter>().sharedMesh = new UnityEngine.Mesh { name = node.Mesh.Value.Name };
                }
                else if (node.Mesh != null)
                {
                    Repeat(made.transform, node);
                }
                foreach (GLTFImportPluginContext plugin in Plugins)
                {
                    plugin.OnAfterImportNode(node, i, made);
                }
            }
            return scene;
        }

        static void Repeat(Transform parent, Node node)
        {
            var instances = new GameObject("Instances");
            instances.transform.SetParent(parent, false);
            for (int i = 0; i < node.Instances; i++)
            {
                var made = new GameObject("Instance " + i);
                made.transform.SetParent(instances.transform, false);
                made.AddComponent<MeshFilter>().sharedMesh = new UnityEngine.Mesh { name = node.Mesh.Value.Name };
            }
        }
    }
}
