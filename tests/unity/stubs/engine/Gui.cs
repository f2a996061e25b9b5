// Test-only stand-ins, never shipped. Immediate-mode drawing is recorded in GUI.Drawn; the buttons in GUI.Pressed, set
// by a test, are pressed.
using System.Collections.Generic;

namespace UnityEngine
{
    public class GUIContent
    {
        public string text { get; set; }
        public string tooltip { get; set; }
        public static readonly GUIContent none = new GUIContent("");
        public GUIContent(string text) : this(text, "") { }
        public GUIContent(string text, string tooltip) { this.text = text; this.tooltip = tooltip; }
    }

    public sealed class GUILayoutOption { }

    public enum FocusType
    {
        Keyboard = 1,
        Passive = 2
    }

    public class GUIStyle
    {
        public bool wordWrap { get; set; }
        public int fontSize { get; set; }
        public GUIStyle() { }
        public GUIStyle(GUIStyle other) { }
    }

    public sealed class GUISkin
    {
        public readonly GUIStyle label = new GUIStyle();
        public readonly GUIStyle box = new GUIStyle();
        public readonly GUIStyle button = new GUIStyle();
    }

    /// Not: an error for calls from outside OnGUI, for a Begin without its End, or for buttons that are not enabled.
    public static class GUI
    {
        public static readonly List<string> Drawn = new List<string>();
        public static readonly HashSet<string> Pressed = new HashSet<string>();
        public static Color color { get; set; }
        public static bool enabled { get; set; }
        public static bool changed { get; set; }
        static GUI() { color = Color.white; enabled = true; }
        public static readonly GUISkin skin = new GUISkin();
        /// Of labels and textures, in the order in which they were drawn.
        public static readonly List<KeyValuePair<Rect, object>> Placed = new List<KeyValuePair<Rect, object>>();
        public static void Label(Rect rect, string text) { Drawn.Add("label " + text); Place(rect, text); }
        static void Place(Rect rect, object what) { Placed.Add(new KeyValuePair<Rect, object>(rect, what)); }
        public static void Box(Rect rect, string text) { Drawn.Add("box " + text); }
        public static bool Button(Rect rect, string text) { Drawn.Add("button " + text); return false; }
        public static bool Toggle(Rect rect, bool value, string text) { Drawn.Add("toggle " + text); return value; }
        public static float HorizontalSlider(Rect rect, float value, float low, float high) { return value; }
        public static void DrawTexture(Rect rect, Texture texture) { Drawn.Add("texture"); Place(rect, texture); }
    }

    public static class GUILayout
    {
        public static void Label(string text, params GUILayoutOption[] options) { GUI.Drawn.Add("label " + text); }
        public static bool Button(string text, params GUILayoutOption[] options)
        {
            GUI.Drawn.Add("button " + text);
            return GUI.Pressed.Contains(text);
        }

        public static bool Button(GUIContent text, params GUILayoutOption[] options) { return Button(text.text); }
        public static bool Toggle(bool value, string text, params GUILayoutOption[] options) { return value; }
        public static float HorizontalSlider(float value, float low, float high, params GUILayoutOption[] options)
        {
            return value;
        }
        public static void BeginArea(Rect rect) { }
        public static void EndArea() { }
        public static void BeginHorizontal(params GUILayoutOption[] options) { }
        public static void EndHorizontal() { }
        public static void BeginVertical(params GUILayoutOption[] options) { }
        public static void EndVertical() { }
        public static void Space(float pixels) { }
        public static void FlexibleSpace() { }
        public static GUILayoutOption Width(float width) { return new GUILayoutOption(); }
        public static GUILayoutOption Height(float height) { return new GUILayoutOption(); }
        public static GUILayoutOption ExpandWidth(bool expand) { return new GUILayoutOption(); }
    }

    public static class GUIUtility
    {
        public static string systemCopyBuffer { get; set; }
    }

    public enum EventType
    {
        Layout,
        Repaint
    }

    public sealed class Event
    {
        public static readonly Event current = new Event();
        public EventType type { get; set; } = EventType.Layout; // set by a test
    }

    public static class GL
    {
        public const int LINES = 1;
        public static void PushMatrix() { }
        public static void PopMatrix() { }
        public static void LoadPixelMatrix() { }
        public static void Begin(int mode) { }
        public static void End() { }
        public static void Color(Color color) { }
        public static void Vertex3(float x, float y, float z) { }
    }
}
