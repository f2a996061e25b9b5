// Test-only stand-ins, never shipped. Objects, their life and death: destroyed ones equal null, as in Unity; messages
// come from Player. No scenes, layers, tags or serialisation.
using System;
using System.Collections.Generic;
using System.Reflection;

namespace UnityEngine
{
    [Flags]
    public enum HideFlags
    {
        None = 0,
        HideInHierarchy = 1,
        HideInInspector = 2,
        DontSaveInEditor = 4,
        NotEditable = 8,
        DontSaveInBuild = 16,
        DontUnloadUnusedAsset = 32,
        DontSave = 52,
        HideAndDontSave = 61
    }

    public class UnityException : SystemException
    {
        public UnityException(string message) : base(message) { }
    }

    public class MissingReferenceException : SystemException
    {
        public MissingReferenceException(string message) : base(message) { }
    }

    /// Faithful: ==, implicit bool, Destroy at the frame's end, DestroyImmediate. Not: Instantiate, an error for a
    /// component that another one requires or for an asset that is destroyed by accident.
    public class Object
    {
        static int lastId;
        internal bool destroyed;
        internal bool ending; // being destroyed: its OnDisable and OnDestroy are called
        internal string held = "";
        internal HideFlags flags;
        readonly int id = ++lastId;

        public string name
        {
            get { Living(); return held; }
            set { Living(); held = value; }
        }

        public HideFlags hideFlags
        {
            get { Living(); return flags; }
            set { Living(); flags = value; }
        }

        internal void Living()
        {
            if (destroyed)
            {
                throw new MissingReferenceException("The object of type '" + GetType().Name +
                    "' has been destroyed but you are still trying to access it.");
            }
        }

        static bool Same(Object a, Object b)
        {
            if ((object)a == null || (object)b == null)
            {
                Object one = (object)a == null ? b : a;
                return (object)one == null || one.destroyed;
            }
            return ReferenceEquals(a, b);
        }

        public static bool operator ==(Object a, Object b) { return Same(a, b); }
        public static bool operator !=(Object a, Object b) { return !Same(a, b); }
        public override bool Equals(object other) { return other == null ? destroyed : ReferenceEquals(this, other); }
        public override int GetHashCode() { return id; }
        public override string ToString() { return destroyed ? "null" : held + " (" + GetType().FullName + ")"; }

        public static void Destroy(Object obj) { Player.DestroyLater(obj); }
        public static void DestroyImmediate(Object obj) { Player.DestroyNow(obj); }
        public static void DestroyImmediate(Object obj, bool allowDestroyingAssets) { Player.DestroyNow(obj); }
        public static void DontDestroyOnLoad(Object target) { Player.Keep(target); }

        /// Only active objects in the scene, as in Unity.
        public static T[] FindObjectsOfType<T>() where T : Object
        {
            List<T> found = new List<T>();
            foreach (GameObject go in Player.All())
            {
                if (go.activeInHierarchy)
                {
                    found.AddRange(go.GetComponents<T>());
                }
            }
            return found.ToArray();
        }

        public static T FindObjectOfType<T>() where T : Object
        {
            T[] all = FindObjectsOfType<T>();
            return all.Length > 0 ? all[0] : null;
        }
    }

    public enum PrimitiveType
    {
        Sphere,
        Capsule,
        Cylinder,
        Cube,
        Plane,
        Quad
    }

    /// Faithful: components, required components, activity through parents, the quad's mesh. Not: tags, layers, scenes,
    /// the meshes of other primitives. A missing component is null itself; in Unity's editor it may be an object that
    /// only equals null, so the package uses == and never ?? or ?.
    public sealed class GameObject : Object
    {
        internal readonly List<Component> parts = new List<Component>();
        internal bool active = true;

        public GameObject() : this("New Game Object") { }

        public GameObject(string name, params Type[] components)
        {
            held = name;
            Player.Add(this);
            Attach(new Transform());
            foreach (Type type in components)
            {
                AddComponent(type);
            }
        }

        public static GameObject CreatePrimitive(PrimitiveType type)
        {
            GameObject made = new GameObject(type.ToString(), typeof(MeshFilter), typeof(MeshRenderer),
                typeof(Collider));
            if (type == PrimitiveType.Quad)
            {
                made.GetComponent<MeshFilter>().sharedMesh = new Mesh
                {
                    name = "Quad",
                    vertices = new[]
                    {
                        new Vector3(-0.5f, -0.5f, 0f), new Vector3(0.5f, -0.5f, 0f), new Vector3(-0.5f, 0.5f, 0f),
                        new Vector3(0.5f, 0.5f, 0f)
                    },
                    uv = new[] { new Vector2(0f, 0f), new Vector2(1f, 0f), new Vector2(0f, 1f), new Vector2(1f, 1f) },
                    triangles = new[] { 0, 3, 1, 3, 0, 2 }
                };
            }
            return made;
        }

        public Transform transform { get { Living(); return (Transform)parts[0]; } }

        public bool activeInHierarchy
        {
            get
            {
                Living();
                return active && (transform.parent == null || transform.parent.gameObject.activeInHierarchy);
            }
        }

        public void SetActive(bool value)
        {
            Living();
            if (active != value)
            {
                active = value;
                Player.ActivityChanged(this);
            }
        }

        /// The type, or its first base class, of which an object may have only one; null if there is none.
        static Type FindSingle(Type type)
        {
            Type found = null;
            for (; type != typeof(Component) && type != typeof(MonoBehaviour); type = type.BaseType)
            {
                found = type.IsDefined(typeof(DisallowMultipleComponent), false) ? type : found;
            }
            return found;
        }

        public Component AddComponent(Type type)
        {
            Living();
            Type single = FindSingle(type);
            if (single != null && GetComponent(single) != null)
            {
                Debug.LogError("Can't add component '" + type.Name + "' to " + held +
                               " because such a component is already added to the game object!");
                return null;
            }
            foreach (RequireComponent needed in type.GetCustomAttributes(typeof(RequireComponent), true))
            {
                if (GetComponent(needed.m_Type0) == null)
                {
                    AddComponent(needed.m_Type0);
                }
            }
            Component made = (Component)Activator.CreateInstance(type, true);
            Attach(made);
            Player.Added(made);
            return made;
        }

        public T AddComponent<T>() where T : Component { return (T)AddComponent(typeof(T)); }

        void Attach(Component made)
        {
            made.held = held;
            made.owner = this;
            parts.Add(made);
        }

        public Component GetComponent(Type type)
        {
            Living();
            foreach (Component part in parts)
            {
                if (type.IsInstanceOfType(part) && !part.destroyed)
                {
                    return part;
                }
            }
            return null;
        }

        public T GetComponent<T>()
        {
            Living();
            for (int i = 0; i < parts.Count; i++)
            {
                if (parts[i] is T && !parts[i].destroyed)
                {
                    return (T)(object)parts[i];
                }
            }
            return default(T);
        }

        public T[] GetComponents<T>()
        {
            Living();
            List<T> found = new List<T>();
            foreach (Component part in parts)
            {
                if (part is T && !part.destroyed)
                {
                    found.Add((T)(object)part);
                }
            }
            return found.ToArray();
        }

        public T GetComponentInParent<T>()
        {
            for (Transform t = transform; t != null; t = t.parent)
            {
                T found = t.gameObject.GetComponent<T>();
                if (found != null && t.gameObject.activeInHierarchy)
                {
                    return found;
                }
            }
            return default(T);
        }

        public int layer { get; set; }

        public T[] GetComponentsInChildren<T>(bool includeInactive)
        {
            List<T> found = new List<T>();
            if (includeInactive || activeInHierarchy)
            {
                found.AddRange(GetComponents<T>());
            }
            foreach (Transform child in transform.children)
            {
                found.AddRange(child.gameObject.GetComponentsInChildren<T>(includeInactive));
            }
            return found.ToArray();
        }

        public T GetComponentInChildren<T>(bool includeInactive)
        {
            T[] found = GetComponentsInChildren<T>(includeInactive);
            return found.Length > 0 ? found[0] : default(T);
        }
    }

    /// Faithful: ways to its object and its neighbours.
    public class Component : Object
    {
        internal GameObject owner;

        public GameObject gameObject
        {
            get
            {
                Living();
                if ((object)owner == null)
                {
                    throw new UnityException("get_gameObject is not allowed to be called from a constructor");
                }
                return owner;
            }
        }

        public Transform transform { get { return gameObject.transform; } }
        public new string name
        {
            get { return gameObject.name; }
            set { gameObject.name = value; }
        }

        public override string ToString()
        {
            return destroyed || (object)owner == null ? "null" : owner.held + " (" + GetType().FullName + ")";
        }

        public T GetComponent<T>() { return gameObject.GetComponent<T>(); }
        public T[] GetComponents<T>() { return gameObject.GetComponents<T>(); }
        public T GetComponentInParent<T>() { return gameObject.GetComponentInParent<T>(); }
    }

    /// Faithful: OnEnable and OnDisable come at once.
    public class Behaviour : Component
    {
        internal bool on = true;

        public bool enabled
        {
            get { Living(); return on; }
            set
            {
                Living();
                if (on != value)
                {
                    on = value;
                    Player.EnabledChanged(this);
                }
            }
        }

        public bool isActiveAndEnabled { get { Living(); return on && gameObject.activeInHierarchy; } }
    }

    /// Not: coroutines, Invoke, SendMessage.
    public class MonoBehaviour : Behaviour
    {
        internal bool woken, running, started;
    }

    /// Faithful: OnEnable on creation, OnDisable and OnDestroy on the end, in edit mode too. Not: assets' loading.
    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>() where T : ScriptableObject { return (T)CreateInstance(typeof(T)); }

        public static ScriptableObject CreateInstance(Type type)
        {
            ScriptableObject made = (ScriptableObject)Activator.CreateInstance(type, true);
            Player.Send(made, "Awake");
            Player.Send(made, "OnEnable");
            return made;
        }
    }

    public class Collider : Component { }

    public enum RigidbodyInterpolation
    {
        None,
        Interpolate,
        Extrapolate
    }

    public enum ForceMode
    {
        Force = 0,
        Impulse = 1,
        VelocityChange = 2,
        Acceleration = 5
    }

    /// Does not move; records its impulses, unless it is kinematic. Its mass is 1 kg.
    public sealed class Rigidbody : Component
    {
        public Vector3 Impulse;
        public void AddForceAtPosition(Vector3 force, Vector3 position, ForceMode mode)
        {
            if (isKinematic)
            {
                return;
            }
            Impulse += mode == ForceMode.Impulse || mode == ForceMode.VelocityChange ? force : force * Time.fixedDeltaTime;
        }

        public RigidbodyInterpolation interpolation { get; set; }
        public bool isKinematic { get; set; }
    }

    /// Text out of a file of the project.
    public class TextAsset : Object
    {
        public TextAsset() { }
        public TextAsset(string text) { this.text = text; }
        public string text { get; private set; }
        public byte[] bytes { get { return System.Text.Encoding.UTF8.GetBytes(text); } }
    }
}
