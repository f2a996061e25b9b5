// SPDX-License-Identifier: MIT
using UnityEditor;
using UnityEditor.Build;
using UnityEditor.Build.Reporting;
using UnityEngine.SceneManagement;
#if UNITY_7000_0_OR_NEWER
using UnityEditor.Build.Content;
#endif

namespace Knurl.Editing
{
#if UNITY_7000_0_OR_NEWER
    /// <summary>Stores geometry while a scene is built or played. Unity keeps the result until something changes that it
    /// depends on. Unity's own step, which merges static meshes, is such a postprocessor too, of order 0.</summary>
    internal sealed class SceneStep : AssetPostprocessor
    {
        public override int GetPostprocessOrder()
        {
            return BuildCheck.Order;
        }

        /// <summary>Raise it when a scene gets other geometry than before.</summary>
        public override uint GetVersion()
        {
            return 1;
        }

        void OnProcessScene(Scene scene, SceneImportContext sceneContext)
        {
            context.DependsOnCustomDependency(BuildCheck.Dependency);
            foreach (string path in BuildCheck.FilesOf(scene))
            {
                context.DependsOnArtifact(path);
            }
            BuildCheck.Store(scene, sceneContext.loadingReason == ProcessSceneMode.PlayerBuild);
        }
    }
#else
    /// <summary>Stores geometry while a scene is built or played. Unity's own step, which merges static meshes, has order
    /// 0.</summary>
    internal sealed class SceneStep : IProcessSceneWithReport
    {
        public int callbackOrder
        {
            get { return BuildCheck.Order; }
        }

        /// <summary>report: null if the scene is played in the editor.</summary>
        public void OnProcessScene(Scene scene, BuildReport report)
        {
            BuildCheck.Store(scene, report != null);
        }
    }
#endif
}
