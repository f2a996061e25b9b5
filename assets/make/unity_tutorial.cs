// Plays the sample Three Plates with the stand-ins of tests/unity, with the real native library, and writes what a frame of it
// consists of; then the controls of two inspectors. For unity_tutorial.py. SPDX-License-Identifier: MIT
using System;
using System.Globalization;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using Knurl;
using Knurl.Samples;
using UnityEditor;
using UnityEngine;
using UnityEngine.Rendering;
using Object = UnityEngine.Object;

internal static class UnityTutorial
{
    const float From = -0.075f, To = -0.042f; // m: over the first plate
    const float Speed = 0.06f; // m/s
    const float PerPixel = 0.001f; // m: of the stand-in's camera, which looks straight ahead

    static int Main()
    {
        CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        EditorApplication.Load(Assembly.Load("Knurl.Haptics.Editor"));
        Player.EnterPlayMode();
        var demo = new GameObject("Demo").AddComponent<KnurlDemo>();
        Player.Frames(2);
        DrawGui(); // compiled now, so that it takes no time below
        Stroke(demo);
        DrawGui();
        string[] texts = GUI.Placed.Select(pair => pair.Value as string).ToArray();
        double hertz = double.Parse(Regex.Match(texts[1], "(\\S+) Hz").Groups[1].Value);
        if (Math.Abs(hertz - 1000.0 * Speed) > 5.0 || texts[2] != "") // over ridges of 1 mm
        {
            demo.Haptic.StopDevice();
            return 1; // frames or ticks came late
        }
        WriteGui();
        Camera eye = Camera.main;
        Say("eye", eye.transform.localToWorldMatrix);
        WriteObjects();
        Graphics.Drawn.Clear();
        RenderPipelineManager.Begin(eye);
        Graphics.Drawn.ForEach(WriteStripes);
        KnurlSurface surface = Object.FindObjectsOfType<KnurlSurface>().First(each => each.name[0] == 'P'); // the touched one
        WriteInspector(surface);
        WriteInspector(surface.Grating);
        demo.Haptic.StopDevice();
        return 0;
    }

    /// Presses and moves the mouse in steps of a frame.
    static void Stroke(KnurlDemo demo)
    {
        Input.MouseButtons[0] = true;
        float start = Time.realtimeSinceStartup, x = From;
        while (x < To)
        {
            x = From + Speed * (Time.realtimeSinceStartup - start);
            Input.mousePosition = new Vector3(x / PerPixel, 0f, 0f);
            Player.Frames(1);
        }
    }

    static void WriteObjects()
    {
        foreach (KnurlPaint painted in Object.FindObjectsOfType<KnurlPaint>())
        {
            bool isBall = painted.GetComponent<KnurlCursor>() != null;
            Color c = painted.GetComponent<Renderer>().sharedMaterial.color;
            Say(isBall ? "ball" : "plate", painted.transform.localToWorldMatrix, c.r, c.g, c.b);
        }
    }

    static void WriteStripes(Graphics.Drawing drawing)
    {
        Color ridge = drawing.Material.Colors["_Ridge"], groove = drawing.Material.Colors["_Groove"];
        Say("stripes", ridge.r, ridge.g, ridge.b, ridge.a, groove.r, groove.g, groove.b, groove.a);
        for (int i = 0; i < drawing.Mesh.vertexCount; i++)
        {
            Vector3 place = drawing.Matrix.MultiplyPoint3x4(drawing.Mesh.vertices[i]);
            Say("corner", place.x, place.y, place.z, drawing.Mesh.uv[i].x, drawing.Mesh.uv[i].y);
        }
    }

    static void DrawGui()
    {
        var readout = Object.FindObjectsOfType<KnurlReadout>().First();
        GUI.Placed.Clear();
        typeof(KnurlReadout).GetMethod("OnGUI", BindingFlags.Instance | BindingFlags.NonPublic).Invoke(readout, null);
    }

    static void WriteGui()
    {
        foreach (var pair in GUI.Placed)
        {
            var texture = pair.Value as Texture2D;
            Say(texture == null ? "label" : "texture", pair.Key.x, pair.Key.y >= Screen.height / 2 ? pair.Key.y - Screen.height : pair.Key.y,
                pair.Key.width, pair.Key.height,
                texture == null ? pair.Value : Convert.ToBase64String(texture.Pixels.SelectMany(p => new[] { p.r, p.g, p.b, p.a }).ToArray()));
        }
    }

    /// Its controls as they are drawn, each field with its value.
    static void WriteInspector(Object target)
    {
        Type type = Assembly.Load("Knurl.Haptics.Editor").GetTypes().First(each => each
            .GetCustomAttributes(typeof(CustomEditor), false).Cast<CustomEditor>().Any(one => one.InspectedType == target.GetType()));
        Say("inspector", target.GetType().Name);
        EditorGUILayout.Drawn.Clear();
        Editor.CreateEditor(target, type).OnInspectorGUI();
        foreach (string line in EditorGUILayout.Drawn)
        {
            string[] words = line.Split(' ');
            Say("row", line, words[0] == "property" ? Value(target, words[1]) : "");
        }
    }

    static string Value(Object target, string field)
    {
        object value = target.GetType().GetField(field, BindingFlags.Instance | BindingFlags.NonPublic | BindingFlags.Public)
            .GetValue(target);
        var named = value as Object;
        return named != null ? named.name : Convert.ToString(value, CultureInfo.InvariantCulture);
    }

    static void Say(string kind, params object[] values)
    {
        Console.WriteLine(kind + "\t" + string.Join("\t", values.Select(Text).ToArray()));
    }

    static string Text(object value)
    {
        if (value is Matrix4x4)
        {
            var m = (Matrix4x4)value;
            return string.Join("\t", new[] { m.m00, m.m01, m.m02, m.m03, m.m10, m.m11, m.m12, m.m13, m.m20, m.m21, m.m22, m.m23 }
                .Select(each => each.ToString("R")).ToArray());
        }
        return value is float ? ((float)value).ToString("R") : value.ToString();
    }
}
