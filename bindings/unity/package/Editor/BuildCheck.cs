// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEditor.Build;
using UnityEditor.Build.Reporting;
using UnityEngine;
using UnityEngine.Rendering;
using UnityEngine.SceneManagement;

namespace Knurl.Editing
{
    /// <summary>Stores the geometry of a scene's surfaces that would not be felt in a player, or differently: meshes that are
    /// not readable or merged by static batching, and UVs and tangents that Optimize Mesh Data removes because no material's
    /// shader uses them, although a grating's x follows them. Warns of such surfaces in prefabs.</summary>
    internal sealed class BuildCheck : IPreprocessBuildWithReport
    {
        /// <summary>Before Unity's own steps, which have 0: static batching merges meshes.</summary>
        internal const int Order = -1000;

        /// <summary>What a processed scene depends on besides its files, where Unity keeps such scenes.</summary>
        internal const string Dependency = "com.knurl.haptics/optimize-mesh-data";

        public int callbackOrder
        {
            get { return Order; }
        }

        public void OnPreprocessBuild(BuildReport report)
        {
            AssetDatabase.RegisterCustomDependency(Dependency, Hash128.Compute(PlayerSettings.stripUnusedMeshComponents.ToString()));
            foreach (string guid in AssetDatabase.FindAssets("t:Prefab"))
            {
                string path = AssetDatabase.GUIDToAssetPath(guid);
                var prefab = AssetDatabase.LoadAssetAtPath<GameObject>(path);
                foreach (KnurlSurface surface in SurfacesOf(prefab == null ? new GameObject[0] : new[] { prefab }))
                {
                    Mesh mesh = surface.GetComponent<MeshFilter>().sharedMesh;
                    bool isOld = surface.Geometry != null && mesh != null && !surface.Geometry.IsOf(mesh);
                    string fault = isOld ? "its mesh has changed since its geometry was stored" : FaultOf(surface, true);
                    if (fault != null && (isOld || surface.Geometry == null))
                    {
                        Debug.LogWarning("Knurl: " + path + ": the surface '" + surface.name + "' is not felt in the player as "
                            + "in the editor: " + fault + ". Press Store geometry " + (isOld ? "again " : "")
                            + "in its inspector.", surface);
                    }
                }
            }
        }

        /// <summary>isBuild: false if a scene is only played in the editor, where nothing is stripped.</summary>
        internal static void Store(Scene scene, bool isBuild)
        {
            var stored = new Dictionary<Mesh, KnurlGeometry>(); // of a mesh that several surfaces show
            foreach (KnurlSurface surface in SurfacesOf(scene.GetRootGameObjects()))
            {
                Mesh mesh = surface.GetComponent<MeshFilter>().sharedMesh;
                bool isStored = surface.Geometry != null; // by a prefab: the mesh may have changed since
                if (mesh == null || (!isStored && FaultOf(surface, isBuild) == null && !IsBatched(surface)))
                {
                    continue;
                }
                string fault = IsMerged(surface) ? "static batching has merged its mesh before Knurl could store it: clear "
                    + "Batching Static, or press Store geometry in its prefab" : "its mesh '" + mesh.name
                    + "' has no triangles that can be read";
                if (!stored.ContainsKey(mesh))
                {
                    stored.Add(mesh, IsMerged(surface) ? null : KnurlGeometry.Of(mesh));
                }
                if (stored[mesh] != null)
                {
                    surface.Geometry = stored[mesh];
                }
                else if (!isStored)
                {
                    Debug.LogWarning("Knurl: " + scene.path + ": the surface '" + surface.name + "' is not felt: " + fault,
                        surface);
                }
            }
        }

        /// <summary>The files of a scene's meshes: what is stored changes with them.</summary>
        internal static IEnumerable<string> FilesOf(Scene scene)
        {
            return SurfacesOf(scene.GetRootGameObjects())
                .Select(surface => AssetDatabase.GetAssetPath(surface.GetComponent<MeshFilter>().sharedMesh))
                .Where(path => path.StartsWith("Assets/", StringComparison.Ordinal)
                    || path.StartsWith("Packages/", StringComparison.Ordinal)).Distinct();
        }

        static IEnumerable<KnurlSurface> SurfacesOf(IEnumerable<GameObject> roots)
        {
            return roots.SelectMany(root => root.GetComponentsInChildren<KnurlSurface>(true));
        }

        static bool IsMerged(KnurlSurface surface)
        {
            var drawn = surface.GetComponent<Renderer>();
            return drawn != null && drawn.isPartOfStaticBatch;
        }

        static bool IsBatched(KnurlSurface surface)
        {
            StaticEditorFlags flags = GameObjectUtility.GetStaticEditorFlags(surface.gameObject);
            return (flags & StaticEditorFlags.BatchingStatic) != 0;
        }

        /// <summary>Why the mesh itself is not felt in a player as in the editor; null if it is.</summary>
        internal static string FaultOf(KnurlSurface surface, bool isStripped)
        {
            Mesh mesh = surface.GetComponent<MeshFilter>().sharedMesh;
            var drawn = surface.GetComponent<Renderer>();
            bool needsUvs = surface.Axis == Vector3.zero && !surface.BoxCoordinates;
            return mesh == null || surface.Grating == null ? null
                : !mesh.isReadable ? "Read/Write is off in the import settings of its mesh"
                : isStripped && PlayerSettings.stripUnusedMeshComponents && needsUvs
                    && (drawn == null || !drawn.sharedMaterials.Any(HasTexture))
                ? "its x follows UVs or tangents that none of its materials uses, and Optimize Mesh Data leaves them out"
                : null;
        }

        /// <summary>A shader with a texture uses UVs.</summary>
        static bool HasTexture(Material material)
        {
            Shader shader = material == null ? null : material.shader;
            for (int i = 0; shader != null && i < shader.GetPropertyCount(); i++)
            {
                if (shader.GetPropertyType(i) == ShaderPropertyType.Texture)
                {
                    return true;
                }
            }
            return false;
        }
    }
}
