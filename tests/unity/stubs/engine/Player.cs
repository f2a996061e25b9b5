// Test-only, never shipped: sends messages to components as Unity does, by reflection on methods of any visibility.
// Exceptions are logged and go no further.
using System;
using System.Collections.Generic;
using System.Reflection;
using System.Threading;

namespace UnityEngine
{
    /// Faithful: Awake and OnEnable at once on adding to an active object; Start before the first Update; the order of
    /// DefaultExecutionOrder, then of creation; Destroy at the frame's end; quitting, pausing, leaving a scene, play mode
    /// with statics kept. Not: physics, rendering, coroutines, what a scene file stores. In edit mode only
    /// ExecuteAlways and ExecuteInEditMode get messages.
    public static class Player
    {
        /// What an editor would tell its own listeners, in the order of UnityEditor.PlayModeStateChange.
        public static Action<int> PlayModeChanged;
        public static Action AssemblyReload;

        sealed class Kind
        {
            internal readonly Dictionary<string, MethodInfo> Methods = new Dictionary<string, MethodInfo>();
            internal readonly Dictionary<string, Action<object>> Calls = new Dictionary<string, Action<object>>();
            internal int Order;
            internal bool InEditMode;
        }

        const BindingFlags Any = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic |
                                 BindingFlags.DeclaredOnly;
        static readonly Dictionary<Type, Kind> kinds = new Dictionary<Type, Kind>();
        static readonly List<GameObject> objects = new List<GameObject>();
        static readonly List<Object> dying = new List<Object>();
        static readonly List<Object> kept = new List<Object>();
        static readonly List<MonoBehaviour> turn = new List<MonoBehaviour>();

        // ---- frames

        /// One frame.
        public static void Frame()
        {
            Time.frameCount++;
            Time.unscaledDeltaTime = 1f / 60f;
            Time.deltaTime = Time.timeScale / 60f;
            Time.time += Time.deltaTime;
            Time.unscaledTime += Time.unscaledDeltaTime;
            Starts();
            if (Time.timeScale > 0f)
            {
                ToAll("FixedUpdate");
            }
            ToAll("Update");
            Starts();
            ToAll("LateUpdate");
            BuryTheDead();
        }

        /// Frames, 2 ms apart.
        public static void Frames(int count)
        {
            for (int i = 0; i < count; i++)
            {
                Frame();
                Thread.Sleep(2);
            }
        }

        /// Frames until something is true: at once where it is; false after `seconds`.
        public static bool Until(Func<bool> what, double seconds)
        {
            DateTime end = DateTime.UtcNow.AddSeconds(seconds);
            while (!what())
            {
                if (DateTime.UtcNow > end)
                {
                    return false;
                }
                Frames(1);
            }
            return true;
        }

        public static bool Until(Func<bool> what) { return Until(what, 20.0); }

        // ---- play mode and what ends it

        /// As the editor's play button with domain reload switched off: statics stay as they are.
        public static void EnterPlayMode()
        {
            Tell(1);
            Application.isPlaying = true;
            Initialise(RuntimeInitializeLoadType.SubsystemRegistration);
            Initialise(RuntimeInitializeLoadType.AfterAssembliesLoaded);
            Initialise(RuntimeInitializeLoadType.BeforeSplashScreen);
            Initialise(RuntimeInitializeLoadType.BeforeSceneLoad);
            foreach (MonoBehaviour b in InOrder())
            {
                Wake(b);
            }
            Initialise(RuntimeInitializeLoadType.AfterSceneLoad);
            Tell(2);
        }

        /// The scene's objects do not come back as they were: they are gone.
        public static void ExitPlayMode()
        {
            Tell(3);
            Quit();
            Tell(0);
        }

        /// As a player's end.
        public static void Quit()
        {
            foreach (MonoBehaviour b in InOrder())
            {
                if (b.woken)
                {
                    Send(b, "OnApplicationQuit");
                }
            }
            Application.Quitting();
            kept.Clear();
            LeaveScene();
            Application.isPlaying = false;
        }

        /// All objects go, as with LoadScene; those of DontDestroyOnLoad stay.
        public static void LeaveScene()
        {
            foreach (GameObject go in objects.ToArray())
            {
                if (!go.destroyed && go.transform.parent == null && !kept.Contains(go))
                {
                    DestroyNow(go);
                }
            }
            BuryTheDead();
        }

        /// What scripts hear before an assembly reload: the event first, then OnDisable everywhere. The domain itself is
        /// the test's to unload.
        public static void ReloadAssemblies()
        {
            if (AssemblyReload != null)
            {
                AssemblyReload();
            }
            foreach (MonoBehaviour b in InOrder())
            {
                Disable(b);
            }
        }

        public static void Pause(bool paused)
        {
            foreach (MonoBehaviour b in InOrder())
            {
                if (b.woken)
                {
                    Send(b, "OnApplicationPause", paused);
                }
            }
        }

        public static void Focus(bool focused)
        {
            Application.Focus(focused);
            foreach (MonoBehaviour b in InOrder())
            {
                if (b.woken)
                {
                    Send(b, "OnApplicationFocus", focused);
                }
            }
        }

        /// For a test's beginning: nothing of an earlier one is left.
        public static void Clear()
        {
            if (Application.isPlaying)
            {
                ExitPlayMode();
            }
            kept.Clear();
            LeaveScene();
            dying.Clear();
            Time.timeScale = 1f;
        }

        static void Tell(int state)
        {
            if (PlayModeChanged != null)
            {
                PlayModeChanged(state);
            }
        }

        static void Initialise(RuntimeInitializeLoadType type)
        {
            const BindingFlags statics = BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;
            foreach (Assembly assembly in AppDomain.CurrentDomain.GetAssemblies())
            {
                if (!assembly.GetName().Name.StartsWith("Knurl", StringComparison.Ordinal))
                {
                    continue;
                }
                foreach (Type t in assembly.GetTypes())
                {
                    foreach (MethodInfo method in t.GetMethods(statics | BindingFlags.DeclaredOnly))
                    {
                        foreach (RuntimeInitializeOnLoadMethodAttribute a in method.GetCustomAttributes(
                                     typeof(RuntimeInitializeOnLoadMethodAttribute), false))
                        {
                            if (a.loadType == type)
                            {
                                Guard(() => method.Invoke(null, null), null);
                            }
                        }
                    }
                }
            }
        }

        // ---- objects

        internal static void Add(GameObject go) { objects.Add(go); }
        internal static GameObject[] All() { return objects.ToArray(); }

        internal static void Keep(Object target)
        {
            Component part = target as Component;
            kept.Add(part != null ? part.gameObject : target);
        }

        internal static void Added(Component made)
        {
            MonoBehaviour b = made as MonoBehaviour;
            if (b == null)
            {
                return;
            }
            if (!Application.isPlaying)
            {
                Send(b, "Reset");
                Send(b, "OnValidate");
            }
            Wake(b);
        }

        static void Wake(MonoBehaviour b)
        {
            if (b.destroyed || !Runs(b) || !b.gameObject.activeInHierarchy)
            {
                return;
            }
            if (!b.woken)
            {
                b.woken = true;
                if (!Send(b, "Awake"))
                {
                    b.on = false;
                }
            }
            if (!b.destroyed && b.on && !b.running && b.gameObject.activeInHierarchy)
            {
                b.running = true;
                Send(b, "OnEnable");
            }
        }

        static void Disable(MonoBehaviour b)
        {
            if (b.running)
            {
                b.running = false;
                Send(b, "OnDisable");
            }
        }

        internal static void EnabledChanged(Behaviour behaviour)
        {
            MonoBehaviour b = behaviour as MonoBehaviour;
            if (b == null)
            {
                return;
            }
            if (b.on)
            {
                Wake(b);
            }
            else
            {
                Disable(b);
            }
        }

        internal static void ActivityChanged(GameObject go)
        {
            bool isActive = go.activeInHierarchy;
            foreach (Component part in go.parts.ToArray())
            {
                MonoBehaviour b = part as MonoBehaviour;
                if (b != null && isActive)
                {
                    Wake(b);
                }
                else if (b != null)
                {
                    Disable(b);
                }
            }
            foreach (Transform child in go.transform.children.ToArray())
            {
                if (child.gameObject.active)
                {
                    ActivityChanged(child.gameObject);
                }
            }
        }

        internal static void DestroyLater(Object target)
        {
            if (target == null)
            {
                return;
            }
            if (!Application.isPlaying)
            {
                Debug.LogError("Destroy may not be called from edit mode! Use DestroyImmediate instead.");
                return;
            }
            dying.Add(target);
        }

        static void BuryTheDead()
        {
            for (int i = 0; i < dying.Count; i++)
            {
                DestroyNow(dying[i]);
            }
            dying.Clear();
        }

        internal static void DestroyNow(Object target)
        {
            if (target == null)
            {
                return;
            }
            GameObject go = target as GameObject;
            Component part = target as Component;
            if (go != null)
            {
                DisableAll(go);
                EndAll(go);
            }
            else if (part != null)
            {
                MonoBehaviour b = part as MonoBehaviour;
                if (b != null)
                {
                    Disable(b);
                    End(b);
                }
                part.owner.parts.Remove(part);
                part.destroyed = true;
            }
            else
            {
                if (target is ScriptableObject)
                {
                    Send(target, "OnDisable");
                    Send(target, "OnDestroy");
                }
                target.destroyed = true;
            }
        }

        static void DisableAll(GameObject go)
        {
            foreach (Component part in go.parts.ToArray())
            {
                if (part is MonoBehaviour)
                {
                    Disable((MonoBehaviour)part);
                }
            }
            foreach (Transform child in go.transform.children.ToArray())
            {
                DisableAll(child.gameObject);
            }
        }

        static void End(MonoBehaviour b)
        {
            if (b.woken)
            {
                Send(b, "OnDestroy");
            }
        }

        static void EndAll(GameObject go)
        {
            foreach (Transform child in go.transform.children.ToArray())
            {
                EndAll(child.gameObject);
            }
            foreach (Component part in go.parts)
            {
                if (part is MonoBehaviour)
                {
                    End((MonoBehaviour)part);
                }
            }
            go.transform.Detach();
            foreach (Component part in go.parts)
            {
                part.destroyed = true;
            }
            go.destroyed = true;
            objects.Remove(go);
        }

        // ---- messages

        static Kind KindOf(Type type)
        {
            Kind kind;
            if (!kinds.TryGetValue(type, out kind))
            {
                kind = new Kind();
                object[] order = type.GetCustomAttributes(typeof(DefaultExecutionOrder), true);
                kind.Order = order.Length > 0 ? ((DefaultExecutionOrder)order[0]).order : 0;
                kind.InEditMode = type.IsDefined(typeof(ExecuteAlways), true) ||
                                  type.IsDefined(typeof(ExecuteInEditMode), true);
                kinds.Add(type, kind);
            }
            return kind;
        }

        static bool Runs(MonoBehaviour b) { return Application.isPlaying || KindOf(b.GetType()).InEditMode; }

        static MethodInfo Method(Kind kind, Type type, string name)
        {
            MethodInfo method;
            if (!kind.Methods.TryGetValue(name, out method))
            {
                for (Type t = type; t != null && method == null && t != typeof(Object); t = t.BaseType)
                {
                    method = t.GetMethod(name, Any);
                }
                kind.Methods.Add(name, method);
            }
            return method;
        }

        // Without allocation once a type is known, so that tests can count what a frame allocates.
        static Action<object> Call(Type type, string name)
        {
            Kind kind = KindOf(type);
            Action<object> call;
            if (!kind.Calls.TryGetValue(name, out call))
            {
                MethodInfo method = Method(kind, type, name);
                if (method != null)
                {
                    MethodInfo bind = typeof(Player).GetMethod("Bind", BindingFlags.Static | BindingFlags.NonPublic);
                    call = (Action<object>)bind.MakeGenericMethod(method.DeclaringType)
                        .Invoke(null, new object[] { method });
                }
                kind.Calls.Add(name, call);
            }
            return call;
        }

        static Action<object> Bind<T>(MethodInfo method) where T : class
        {
            Action<T> open = (Action<T>)Delegate.CreateDelegate(typeof(Action<T>), method);
            return target => open((T)target);
        }

        /// False where the method threw; true also where there is none.
        internal static bool Send(Object target, string name)
        {
            try
            {
                Action<object> call = Call(target.GetType(), name);
                if (call != null)
                {
                    call(target);
                }
                return true;
            }
            catch (Exception e)
            {
                Debug.LogException(e, target);
                return false;
            }
        }

        static void Send(Object target, string name, object value)
        {
            MethodInfo method = Method(KindOf(target.GetType()), target.GetType(), name);
            if (method != null)
            {
                Guard(() => method.Invoke(target, new[] { value }), target);
            }
        }

        static void Guard(Action what, Object context)
        {
            try
            {
                what();
            }
            catch (TargetInvocationException e)
            {
                Debug.LogException(e.InnerException, context);
            }
            catch (Exception e)
            {
                Debug.LogException(e, context);
            }
        }

        static List<MonoBehaviour> InOrder()
        {
            List<MonoBehaviour> all = new List<MonoBehaviour>();
            Collect(all);
            return all;
        }

        static void Collect(List<MonoBehaviour> all)
        {
            all.Clear();
            for (int i = 0; i < objects.Count; i++)
            {
                List<Component> parts = objects[i].parts;
                for (int j = 0; j < parts.Count; j++)
                {
                    MonoBehaviour b = parts[j] as MonoBehaviour;
                    if ((object)b != null)
                    {
                        Insert(all, b);
                    }
                }
            }
        }

        // Stable: from behind, past those of a later order.
        static void Insert(List<MonoBehaviour> all, MonoBehaviour b)
        {
            int order = KindOf(b.GetType()).Order;
            int at = all.Count;
            while (at > 0 && KindOf(all[at - 1].GetType()).Order > order)
            {
                at--;
            }
            all.Insert(at, b);
        }

        static void Starts()
        {
            Collect(turn);
            for (int i = 0; i < turn.Count; i++)
            {
                if (turn[i].running && !turn[i].started)
                {
                    turn[i].started = true;
                    Send(turn[i], "Start");
                }
            }
        }

        static void ToAll(string name)
        {
            Collect(turn);
            for (int i = 0; i < turn.Count; i++)
            {
                MonoBehaviour b = turn[i];
                if (b.running && b.started && Runs(b))
                {
                    Send(b, name);
                }
            }
        }
    }
}
