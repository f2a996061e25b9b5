// Test-only stand-ins, never shipped. Static parts: log, time, application, gizmos.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;

namespace UnityEngine
{
    public enum LogType
    {
        Error,
        Assert,
        Warning,
        Log,
        Exception
    }

    /// A line of the log, for tests.
    public sealed class LogLine
    {
        public LogType Type;
        public string Text;
        public Object Context;
        public Exception Exception;
        internal bool isIgnored, isHandled; // by LogAssert
        public override string ToString() { return Type + ": " + Text; }
    }

    /// Records the log in Lines, for tests.
    public static class Debug
    {
        public static readonly List<LogLine> Lines = new List<LogLine>();

        static void Add(LogType type, object message, Object context, Exception exception)
        {
            string text = message == null ? "Null" : message.ToString();
            lock (Lines)
            {
                Lines.Add(new LogLine
                {
                    Type = type, Text = text, Context = context, Exception = exception,
                    isIgnored = TestTools.LogAssert.ignoreFailingMessages
                });
            }
        }

        public static void Log(object message) { Add(LogType.Log, message, null, null); }
        public static void Log(object message, Object context) { Add(LogType.Log, message, context, null); }
        public static void LogWarning(object message) { Add(LogType.Warning, message, null, null); }
        public static void LogWarning(object message, Object context) { Add(LogType.Warning, message, context, null); }
        public static void LogError(object message) { Add(LogType.Error, message, null, null); }
        public static void LogError(object message, Object context) { Add(LogType.Error, message, context, null); }
        public static void LogException(Exception exception) { LogException(exception, null); }

        public static void LogException(Exception exception, Object context)
        {
            Add(LogType.Exception, exception.GetType().Name + ": " + exception.Message, context, exception);
        }
    }

    /// The player moves it; a test may set any of it.
    public static class Time
    {
        static readonly Stopwatch watch = Stopwatch.StartNew();
        public static float timeScale { get; set; }
        public static float deltaTime { get; set; }
        public static float unscaledDeltaTime { get; set; }
        public static float fixedDeltaTime { get; set; }
        public static int frameCount { get; set; }
        public static float time { get; set; }
        public static float unscaledTime { get; set; }
        public static float realtimeSinceStartup { get { return (float)watch.Elapsed.TotalSeconds; } }
        public static double realtimeSinceStartupAsDouble { get { return watch.Elapsed.TotalSeconds; } }
        static Time() { timeScale = 1f; deltaTime = unscaledDeltaTime = 1f / 60f; fixedDeltaTime = 0.02f; }
    }

    /// Paths are the test's to set.
    public static class Application
    {
        public static event Action quitting;
        public static bool isPlaying { get; internal set; }
        public static bool isEditor { get; set; }
        public static string dataPath { get; set; }
        public static string streamingAssetsPath { get; set; }
        public static string persistentDataPath { get; set; }

        static Application()
        {
            isEditor = true;
            dataPath = streamingAssetsPath = persistentDataPath = Environment.CurrentDirectory;
        }

        internal static void Quitting()
        {
            if (quitting == null)
            {
                return;
            }
            foreach (Delegate call in quitting.GetInvocationList())
            {
                try
                {
                    ((Action)call)();
                }
                catch (Exception e)
                {
                    Debug.LogException(e);
                }
            }
        }
    }

    /// Records drawing.
    public static class Gizmos
    {
        public static readonly List<string> Drawn = new List<string>();
        public static readonly List<Matrix4x4> WireCubes = new List<Matrix4x4>(); // the matrix of each
        public static Color color { get; set; }
        public static Matrix4x4 matrix { get; set; }
        static Gizmos() { color = Color.white; matrix = Matrix4x4.identity; }
        public static void DrawLine(Vector3 a, Vector3 b) { Drawn.Add("line " + a + " " + b); }
        public static void DrawWireCube(Vector3 a, Vector3 b)
        {
            Drawn.Add("wire cube " + a + " " + b);
            WireCubes.Add(matrix);
        }

        public static void DrawWireSphere(Vector3 a, float r) { Drawn.Add("wire sphere " + a + " " + r.ToString("G7", CultureInfo.InvariantCulture)); }
        public static void DrawSphere(Vector3 a, float r) { Drawn.Add("sphere " + a + " " + r.ToString("G7", CultureInfo.InvariantCulture)); }
    }

    /// Returns the values that a test sets.
    public static class Input
    {
        public static Vector3 mousePosition { get; set; }
        public static Vector2 mouseScrollDelta { get; set; }
        public static bool[] MouseButtons = new bool[3];
        public static bool GetMouseButton(int button) { return MouseButtons[button]; }
    }

    public struct Ray
    {
        Vector3 along;
        public Vector3 origin { get; set; }
        public Vector3 direction { get { return along; } set { along = value.normalized; } }
        public Ray(Vector3 origin, Vector3 direction) : this()
        {
            this.origin = origin;
            this.direction = direction;
        }

        public Vector3 GetPoint(float distance) { return origin + direction * distance; }
    }

    public struct Plane
    {
        public Vector3 normal { get; set; }
        public float distance { get; set; }
        public Plane(Vector3 normal, Vector3 point) : this()
        {
            this.normal = normal.normalized;
            distance = -Vector3.Dot(this.normal, point);
        }

        public bool Raycast(Ray ray, out float enter)
        {
            float along = Vector3.Dot(ray.direction, normal);
            enter = Mathf.Approximately(along, 0f) ? 0f : -(Vector3.Dot(ray.origin, normal) + distance) / along;
            return enter > 0f;
        }
    }

    /// Looks straight ahead, one pixel a millimetre, without perspective. Not: tags; main is the first that is active.
    public sealed class Camera : Behaviour
    {
        public delegate void CameraCallback(Camera cam);
        public static CameraCallback onPreCull;

        public float nearClipPlane { get; set; }
        public static Camera current { get { return main; } }
        public static Camera main { get { return Object.FindObjectOfType<Camera>(); } }
        public Ray ScreenPointToRay(Vector3 p)
        {
            return new Ray(transform.TransformPoint(new Vector3(p.x * 0.001f, p.y * 0.001f, 0f)), transform.forward);
        }
    }

    public static class Screen
    {
        public static int height { get { return 360; } }
    }
}

namespace UnityEngine.TestTools
{
    using System.Text.RegularExpressions;

    /// Faithful: a set-up, a test's body and a tear-down have a scope each (tests/unity/cases/Scopes.cs ends them, as
    /// Unity's runner does). At its end an unexpected error, assertion or exception fails the test, and so does a
    /// missing expected one; expected ones must come in order. NoUnexpectedReceived()
    /// fails on any line of its own scope that was not expected, plain ones too. Not: frames, UnityTest's scopes.
    public static class LogAssert
    {
        sealed class Expected
        {
            internal LogType Type;
            internal Regex Pattern;
        }

        static readonly Queue<Expected> expected = new Queue<Expected>();
        public static bool ignoreFailingMessages { get; set; }

        public static void Expect(LogType type, string message)
        {
            Expect(type, new Regex("^" + Regex.Escape(message) + "$"));
        }

        public static void Expect(LogType type, Regex message)
        {
            expected.Enqueue(new Expected { Type = type, Pattern = message });
        }

        static void Match()
        {
            foreach (LogLine line in Debug.Lines)
            {
                if (expected.Count > 0 && !line.isHandled && expected.Peek().Type == line.Type
                    && expected.Peek().Pattern.IsMatch(line.Text))
                {
                    expected.Dequeue();
                    line.isHandled = true;
                }
            }
        }

        static string Text(LogLine line)
        {
            return "unexpected " + line + (line.Exception == null ? "" : "\n" + line.Exception);
        }

        public static void NoUnexpectedReceived()
        {
            lock (Debug.Lines)
            {
                Match();
                LogLine first = Debug.Lines.Find(line => !line.isHandled);
                if (first != null)
                {
                    throw new Exception(Text(first));
                }
            }
        }

        /// For the runner.
        public static void EndScope()
        {
            List<string> wrong = new List<string>();
            lock (Debug.Lines)
            {
                Match();
                foreach (LogLine line in Debug.Lines)
                {
                    bool fails = line.Type != LogType.Log && line.Type != LogType.Warning;
                    if (fails && !line.isHandled && !line.isIgnored)
                    {
                        wrong.Add(Text(line));
                    }
                }
                Debug.Lines.Clear();
            }
            foreach (Expected e in expected)
            {
                wrong.Add("missing " + e.Type + ": " + e.Pattern);
            }
            expected.Clear();
            ignoreFailingMessages = false;
            if (wrong.Count > 0)
            {
                throw new Exception(string.Join("\n", wrong.ToArray()));
            }
        }
    }
}
