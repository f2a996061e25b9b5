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
        public GUIStyle() { }
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
        static GUI() { color = Color.white; enabled = true; }
        public static readonly GUISkin skin = new GUISkin();
        /// Of labels and textures, in the order in which they were drawn.
        public static readonly List<KeyValuePair<Rect, object>> Placed = new List<KeyValuePair<Rect, object>>();
        public static void Label(Rect rect, string text) { Drawn.Add("label " + text); Place(rect, text); }
        static void Place(Rect rect, object what) { Placed.Add(new KeyValuePair<Rect, object>(rect, what)); }
        public static void DrawTexture(Rect rect, Texture texture) { Drawn.Add("texture"); Place(rect, texture); }
    }

    public static class GUILayout
    {
        public static bool Button(string text, params GUILayoutOption[] options)
        {
            GUI.Drawn.Add("button " + text);
            return GUI.Pressed.Contains(text);
        }
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
}
