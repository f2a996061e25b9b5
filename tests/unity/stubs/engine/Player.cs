// Test-only, never shipped: sends messages to components as Unity does, by reflection on methods of any visibility.
// Exceptions are logged and go no further.
using System;
using System.Collections.Generic;
using System.Reflection;
using System.Threading;

namespace UnityEngine
{
    /// Faithful: Awake and OnEnable at once on adding to an active object; Start before the first Update; the order of
    /// DefaultExecutionOrder, then of creation; Destroy at the frame's end; quitting, pausing, leaving a scene, play
    /// mode with statics kept. Not: physics, rendering, coroutines, data in scene files. In edit mode only
    /// ExecuteAlways and ExecuteInEditMode get messages.
    public static partial class Player
    {
        /// Events for an editor's own listeners, in the order of UnityEditor.PlayModeStateChange.
        public static Action<int> PlayModeChanged;
        public static Action AssemblyReload;

        static double latestFrame;
        static float due; // s of physics steps
        static readonly List<GameObject> objects = new List<GameObject>();
        static readonly List<Object> dying = new List<Object>();
        static readonly List<Object> kept = new List<Object>();
        static readonly List<MonoBehaviour> turn = new List<MonoBehaviour>();

        /// One frame.
        public static void Frame()
        {
            Time.frameCount++;
            Time.unscaledDeltaTime = Math.Max(1e-4f, (float)(Time.realtimeSinceStartupAsDouble - latestFrame));
            latestFrame = Time.realtimeSinceStartupAsDouble;
            Time.deltaTime = Math.Min(Time.unscaledDeltaTime, 1f / 3f) * Time.timeScale; // Time.maximumDeltaTime
            Time.time += Time.deltaTime;
            Time.unscaledTime += Time.unscaledDeltaTime;
            Starts();
            float frame = Time.deltaTime;
            for (due += frame; due >= Time.fixedDeltaTime; due -= Time.fixedDeltaTime)
            {
                Time.deltaTime = Time.fixedDeltaTime;
                ToAll("FixedUpdate");
            }
            Time.deltaTime = frame;
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

        /// Runs frames until a condition is true, none if it already is; false after `seconds`.
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
                if (!go.destroyed && !go.ending && go.transform.parent == null && !kept.Contains(go))
                {
                    DestroyNow(go);
                }
            }
            BuryTheDead();
        }

        /// Messages to scripts before an assembly reload: the event first, then OnDisable everywhere. The test unloads
        /// the domain itself.
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

        /// As an Animator does after it has written to serialised fields.
        public static void ApplyAnimation(MonoBehaviour b)
        {
            Send(b, "OnDidApplyAnimationProperties");
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
    }
}
