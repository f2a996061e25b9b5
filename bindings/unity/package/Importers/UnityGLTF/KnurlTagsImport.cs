// SPDX-License-Identifier: MIT
using System.Linq;
using GLTF.Schema;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using UnityEngine;
using UnityGLTF.Plugins;

namespace Knurl.Importing
{
    /// <summary>A plugin of UnityGLTF: objects whose node, mesh or material has a tag in its extras get a KnurlSurface,
    /// in the editor and in games. UnityGLTF finds it by itself and lists it in its settings.</summary>
    public sealed class KnurlTagsImport : GLTFImportPlugin
    {
        /// <summary>Its name in UnityGLTF's settings.</summary>
        public override string DisplayName
        {
            get { return "Knurl tags"; }
        }

        /// <summary>Its description there.</summary>
        public override string Description
        {
            get { return "Objects that are tagged with gratings can be felt."; }
        }

        /// <summary>Called by UnityGLTF, once for each file.</summary>
        public override GLTFImportPluginContext CreateInstance(GLTFImportContext context)
        {
            return new Attaching();
        }

        sealed class Attaching : GLTFImportPluginContext
        {
            /// <summary>The object has its mesh by now: one with all primitives, which feels like the first that is
            /// tagged.</summary>
            public override void OnAfterImportNode(Node node, int nodeIndex, GameObject nodeObject)
            {
                GLTFMesh mesh = node.Mesh == null ? null : node.Mesh.Value;
                int count = mesh == null || mesh.Primitives == null ? 0 : mesh.Primitives.Count;
                GameObject[] owners = OwnersOf(nodeObject);
                bool isDone = false;
                for (int i = 0; i < count && !isDone; i++)
                {
                    MaterialId used = mesh.Primitives[i].Material;
                    GLTFMaterial material = used == null ? null : used.Value;
                    isDone = ImportedFile.Attach(nodeObject, owners, Text(node.Extras), Text(mesh.Extras),
                        material == null ? null : Text(material.Extras), material != null && material.DoubleSided);
                }
            }

            /// <summary>A node that is instanced (EXT_mesh_gpu_instancing) has no mesh itself, but a child Instances, whose
            /// children Instance 0 and so on have it.</summary>
            static GameObject[] OwnersOf(GameObject nodeObject)
            {
                Transform first = nodeObject.transform.Find("Instances/Instance 0");
                return first == null || first.GetComponent<MeshFilter>() == null ? new[] { nodeObject }
                    : first.parent.gameObject.GetComponentsInChildren<MeshFilter>(true).Select(filter => filter.gameObject).ToArray();
            }

            static string Text(JToken extras)
            {
                return extras == null ? null : extras.ToString(Formatting.None);
            }
        }
    }
}
