// Test-only stand-ins, never shipped. Notified by the player.
using System;
using System.Reflection;
using System.Runtime.CompilerServices;
using UnityEngine;

namespace UnityEditor
{
    public enum PlayModeStateChange
    {
        EnteredEditMode,
        ExitingEditMode,
        EnteredPlayMode,
        ExitingPlayMode
    }

    /// Faithful: the order of play-mode states. Not: update while editing, which a test calls by Update();
    /// isPlayingOrWillChangePlaymode is isPlaying, in Unity it is true already in ExitingEditMode.
    public static class EditorApplication
    {
        public delegate void CallbackFunction();

        public static event Action<PlayModeStateChange> playModeStateChanged;
        public static CallbackFunction delayCall;
        public static event Action quitting;
        public static bool isPlaying { get { return Application.isPlaying; } }
        public static double timeSinceStartup { get { return Time.realtimeSinceStartup; } }

        static EditorApplication()
        {
            Player.PlayModeChanged += state =>
            {
                if (playModeStateChanged != null)
                {
                    playModeStateChanged((PlayModeStateChange)state);
                }
            };
        }

        /// The editor's actions with a loaded assembly.
        public static void Load(Assembly assembly)
        {
            const BindingFlags statics = BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;
            foreach (Type type in assembly.GetTypes())
            {
                if (type.IsDefined(typeof(InitializeOnLoadAttribute), false))
                {
                    RuntimeHelpers.RunClassConstructor(type.TypeHandle);
                }
                foreach (MethodInfo method in type.GetMethods(statics))
                {
                    if (method.IsDefined(typeof(InitializeOnLoadMethodAttribute), false))
                    {
                        method.Invoke(null, null);
                    }
                }
            }
        }

        public static void Quit()
        {
            if (quitting != null)
            {
                quitting();
            }
        }
    }

    public static class AssemblyReloadEvents
    {
        public delegate void AssemblyReloadCallback();

        public static event AssemblyReloadCallback beforeAssemblyReload;

        static AssemblyReloadEvents()
        {
            Player.AssemblyReload += () =>
            {
                if (beforeAssemblyReload != null)
                {
                    beforeAssemblyReload();
                }
            };
        }
    }
}
