// Test-only, never shipped: undo, selection, prefabs, stages, builds.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace UnityEditor
{
    /// Remembers the steps, and undoes nothing.
    public static class Undo
    {
        public static readonly List<string> Steps = new List<string>();
        public static void RecordObject(UnityEngine.Object o, string name) { Steps.Add(name); }
        static void Check(UnityEngine.Object given)
        {
            if (given == null)
            {
                throw new ArgumentNullException("given");
            }
        }

        public static void RegisterCreatedObjectUndo(UnityEngine.Object o, string name)
        {
            Check(o);
            Steps.Add(name);
        }

        public static void SetCurrentGroupName(string name) { Steps.Add(name); }
        public static int GetCurrentGroup() { return Steps.Count; }
        public static void CollapseUndoOperations(int group) { }
        public static void IncrementCurrentGroup() { }

        public static T AddComponent<T>(GameObject go) where T : Component { return (T)AddComponent(go, typeof(T)); }

        public static Component AddComponent(GameObject go, Type type)
        {
            Check(go);
            Steps.Add("Add Component");
            return go.AddComponent(type);
        }
    }

    public static class Selection
    {
        static UnityEngine.Object[] held = new UnityEngine.Object[0];
        public static event Action selectionChanged;
        public static UnityEngine.Object[] objects
        {
            get { return held; }
            set
            {
                held = value;
                if (selectionChanged != null)
                {
                    selectionChanged();
                }
            }
        }

        public static UnityEngine.Object activeObject
        {
            get { return held.Length > 0 ? held[0] : null; }
            set { objects = (object)value == null ? new UnityEngine.Object[0] : new[] { value }; }
        }

        public static GameObject activeGameObject
        {
            get { return activeObject as GameObject; }
            set { activeObject = value; }
        }

        public static string[] assetGUIDs { get { return Array.FindAll(Array.ConvertAll(held, AssetDatabase.GetAssetPath), path => path != ""); } }
        public static GameObject[] gameObjects { get { return Array.FindAll(Array.ConvertAll(held, o => o as GameObject), o => o != null); } }
    }

    public static class EditorUtility
    {
        public static readonly List<string> Dialogs = new List<string>();
        public static string Chosen = "";
        public static void OpenWithDefaultApp(string fileName) { Dialogs.Add("open " + fileName); }
        public static void SetDirty(UnityEngine.Object o) { }
        /// All fields that are serialised, and the name. Not: copies of arrays, which are shared.
        public static void CopySerialized(UnityEngine.Object source, UnityEngine.Object dest)
        {
            const System.Reflection.BindingFlags own = System.Reflection.BindingFlags.Instance
                | System.Reflection.BindingFlags.Public | System.Reflection.BindingFlags.NonPublic;
            foreach (System.Reflection.FieldInfo field in source.GetType().GetFields(own))
            {
                if (field.IsPublic || field.IsDefined(typeof(SerializeField), true))
                {
                    field.SetValue(dest, field.GetValue(source));
                }
            }
            dest.name = source.name;
        }
        public static bool IsPersistent(UnityEngine.Object o) { return AssetDatabase.Contains(o); }
        public static string OpenFilePanelWithFilters(string title, string folder, string[] filters) { return Chosen; }
    }

    public static class FileUtil
    {
        public static string GetProjectRelativePath(string path)
        {
            int at = path.IndexOf("Assets/", StringComparison.Ordinal);
            return at < 0 ? "" : path.Substring(at);
        }
    }

    /// There are no prefabs.
    public static class PrefabUtility
    {
        /// A test fills it in: instance, imported object.
        public static readonly Dictionary<UnityEngine.Object, UnityEngine.Object> Sources
            = new Dictionary<UnityEngine.Object, UnityEngine.Object>();

        public static T GetCorrespondingObjectFromOriginalSource<T>(T o) where T : UnityEngine.Object
        {
            UnityEngine.Object found;
            return Sources.TryGetValue(o, out found) ? (T)found : null;
        }

        public static bool IsPartOfPrefabInstance(UnityEngine.Object o) { return false; }
        public static void RecordPrefabInstancePropertyModifications(UnityEngine.Object o) { }
        public static string GetPrefabAssetPathOfNearestInstanceRoot(UnityEngine.Object o) { return ""; }
    }

    [Flags]
    public enum StaticEditorFlags { BatchingStatic = 4 }

    public static class GameObjectUtility
    {
        /// A test fills it in.
        public static readonly Dictionary<GameObject, StaticEditorFlags> Flags = new Dictionary<GameObject, StaticEditorFlags>();

        public static StaticEditorFlags GetStaticEditorFlags(GameObject go)
        {
            StaticEditorFlags flags;
            return Flags.TryGetValue(go, out flags) ? flags : 0;
        }

        public static void EnsureUniqueNameForSibling(GameObject self) { }
        public static void SetParentAndAlign(GameObject child, GameObject parent)
        {
            if (parent != null)
            {
                child.transform.SetParent(parent.transform, false);
            }
        }
    }

    public static class PlayerSettings
    {
        public static bool stripUnusedMeshComponents { get; set; }
    }

    /// Looks at its pivot.
    public sealed class SceneView
    {
        public static SceneView lastActiveSceneView { get; set; }
        public Vector3 pivot { get; set; }
        public void MoveToView(Transform target) { target.position = pivot; }
    }

    namespace SceneManagement
    {
        public sealed class PrefabStage { }

        public static class PrefabStageUtility
        {
            public static PrefabStage GetPrefabStage(GameObject gameObject)
            {
                return StageUtility.Open != null && gameObject == StageUtility.Open ? new PrefabStage() : null;
            }
        }

        public static class StageUtility
        {
            /// The root of the open prefab, set by a test; it becomes the parent.
            public static GameObject Open;
            public static void PlaceGameObjectInCurrentStage(GameObject gameObject)
            {
                if (Open != null)
                {
                    gameObject.transform.SetParent(Open.transform);
                }
            }
        }
    }

    namespace Build
    {
        public interface IOrderedCallback
        {
            int callbackOrder { get; }
        }

        public interface IPreprocessBuildWithReport : IOrderedCallback
        {
            void OnPreprocessBuild(Reporting.BuildReport report);
        }

        public interface IProcessSceneWithReport : IOrderedCallback
        {
            void OnProcessScene(UnityEngine.SceneManagement.Scene scene, Reporting.BuildReport report);
        }

        namespace Reporting
        {
            public sealed class BuildReport : UnityEngine.Object { }
        }

        /// Of Unity 6.7 and later.
        namespace Content
        {
            public enum ProcessSceneMode { PlayerBuild, PlayMode }

            public struct SceneImportContext
            {
                public SceneImportContext(ProcessSceneMode reason) { loadingReason = reason; }
                public ProcessSceneMode loadingReason { get; }
            }
        }
    }
}
