// SPDX-License-Identifier: MIT
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
    /// <summary>Warns of surfaces that would feel different in a player than in the editor: Optimize Mesh Data removes
    /// UVs and tangents that no material's shader uses, but a grating's x follows them. Checks scenes while they are
    /// built, and prefabs before that.</summary>
    internal sealed class BuildCheck : IPreprocessBuildWithReport, IProcessSceneWithReport
    {
        public int callbackOrder
        {
            get { return 0; }
        }

        public void OnPreprocessBuild(BuildReport report)
        {
            if (!PlayerSettings.stripUnusedMeshComponents)
            {
                return;
            }
            foreach (string guid in AssetDatabase.FindAssets("t:Prefab"))
            {
                string path = AssetDatabase.GUIDToAssetPath(guid);
                var prefab = AssetDatabase.LoadAssetAtPath<GameObject>(path);
                Warn(path, prefab == null ? new GameObject[0] : new[] { prefab });
            }
        }

        /// <summary>report: null if a scene is only played in the editor.</summary>
        public void OnProcessScene(Scene scene, BuildReport report)
        {
            if (report != null && PlayerSettings.stripUnusedMeshComponents)
            {
                Warn(scene.path, scene.GetRootGameObjects());
            }
        }

        static void Warn(string where, IEnumerable<GameObject> roots)
        {
            foreach (KnurlSurface surface in roots.SelectMany(root => root.GetComponentsInChildren<KnurlSurface>(true)))
            {
                if (LosesX(surface))
                {
                    Debug.LogWarning("Knurl: " + where + ": the surface '" + surface.name + "' has its x from UVs or "
                        + "tangents that none of its materials uses: Optimize Mesh Data leaves them out of the player. Give "
                        + "it an Axis or a material with a texture, or switch that off (Project Settings > Player).",
                        surface);
                }
            }
        }

        internal static bool LosesX(KnurlSurface surface)
        {
            Mesh mesh;
            var drawn = surface.GetComponent<Renderer>();
            return surface.Axis == Vector3.zero && !surface.BoxCoordinates && surface.Grating != null && surface.FindMesh(out mesh) == null
                && (drawn == null || !drawn.sharedMaterials.Any(HasTexture));
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
