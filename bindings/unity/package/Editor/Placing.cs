// SPDX-License-Identifier: MIT
using System.Linq;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Positions new objects as Unity does, or at the selected surfaces.</summary>
    internal static class Placing
    {
        /// <summary>Places an object below parent, or, if that is null, in the open stage (scene or prefab) in the
        /// middle of the scene view. Registers undo and selects it.</summary>
        internal static void Place(GameObject made, GameObject parent)
        {
            if (parent != null)
            {
                GameObjectUtility.SetParentAndAlign(made, parent);
            }
            else
            {
                StageUtility.PlaceGameObjectInCurrentStage(made);
                if (SceneView.lastActiveSceneView != null)
                {
                    SceneView.lastActiveSceneView.MoveToView(made.transform);
                }
            }
            GameObjectUtility.EnsureUniqueNameForSibling(made);
            Undo.RegisterCreatedObjectUndo(made, "Create " + made.name);
            Selection.activeGameObject = made;
        }

        /// <summary>The centre of the selected surfaces; false if no surface is selected.</summary>
        internal static bool FindSelectedSurfaces(out Vector3 middle)
        {
            Renderer[] felt = Selection.gameObjects.Where(each => each.GetComponent<KnurlSurface>() != null)
                .Select(each => each.GetComponent<Renderer>()).Where(drawn => drawn != null).ToArray();
            Bounds bounds = felt.Length > 0 ? felt[0].bounds : new Bounds();
            foreach (Renderer each in felt)
            {
                bounds.Encapsulate(each.bounds);
            }
            middle = bounds.center;
            return felt.Length > 0;
        }
    }
}
