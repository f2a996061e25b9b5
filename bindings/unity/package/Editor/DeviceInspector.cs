// SPDX-License-Identifier: MIT
using System;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Shows a device's settings; in play mode also its state, and buttons to start and stop it.</summary>
    [CustomEditor(typeof(KnurlDevice)), CanEditMultipleObjects]
    internal sealed class DeviceInspector : KnurlInspector
    {
        internal static readonly string[] Devices = { "auto", "fake", "mouse", "touch", "falcon", "rawhid", "serial", "dhd", "inverse3" };
        internal static readonly string[] Strokes = { "", "line", "sweep", "circle", "press", "rest" };

        static readonly string[] Events =
        {
            "contactStarted", "contactEnded", "buttonChanged", "fault", "startFailed",
        };

        static readonly GUIContent Device = new GUIContent("Device", "auto (the first that is connected), fake (a simulated hand), mouse (a script " +
            "calls MoveHip), touch, touch:NAME, falcon, rawhid, rawhid:VID:PID; options follow as ?key=value&...");
        static readonly GUIContent Known = new GUIContent("Known devices", "Puts one of these into the field above");
        static readonly GUIContent Stroke = new GUIContent("Stroke", "What the fake device's hand does over the " +
            "first surface: line, sweep, circle, press or rest; empty: it stands still at the workspace's origin");
        static readonly GUIContent Rate = new GUIContent("Rate (Hz)", "Ticks a second");
        static readonly GUIContent Scale = new GUIContent("Workspace Scale", "Metres of the scene per metre that " +
            "the device moves. Walls feel stiffer by as much");
        static readonly GUIContent Autostart = new GUIContent("Autostart", "Whether it starts in its first frame");
        static readonly GUIContent Retry = new GUIContent("Retry (s)", "After so many seconds a start by Autostart that " +
            "failed is tried again; 0: it is not");
        static readonly GUIContent Reconnect = new GUIContent("Reconnect", "Whether a device that was lost is " +
            "looked for again; otherwise losing it stops this component");
        static readonly GUIContent Clamp = new GUIContent("Clamp", "Whether walls and textures beyond what the " +
            "device can do are felt at what it can");
        static readonly GUIContent Even = new GUIContent("Even Sensation", "Lowers the amplitude of gratings at some speeds, " +
            "so that ridges are equally strong from 25 to 300 per second");
        static readonly GUIContent ResponseFile = new GUIContent("Response File", "The device's measured response for Even " +
            "Sensation, a CSV file that knurl sweep writes; none: a model of the device in a hand");
        static readonly GUIContent Paused = new GUIContent("Paused", "Nothing is felt, and where it is goes on being " +
            "told. Counts at once");

        static readonly GUIContent Gain = new GUIContent("Gain", "How much of every force is sent, 0 to 1. Counts at once");
        static readonly GUIContent AddedForce = new GUIContent("Added Force (N)", "A force of the game's own, global, that " +
            "is added to what surfaces give. Counts at once");
        static readonly GUIContent Clutch = new GUIContent("Clutch", "While it is on, nothing is felt and the HIP stays, so " +
            "that the hand can go back to where it has room");
        static readonly GUIContent Sound = new GUIContent("Sound", "Whether what is felt is heard, by the Knurl Sound " +
            "component of this object; one is added where there is none. Counts at once");
        static readonly GUIContent Layers = new GUIContent("Layers", "It feels the surfaces that have one of these layers " +
            "too. Counts at once");


        public override void OnInspectorGUI()
        {
            serializedObject.Update();
            SerializedProperty device = serializedObject.FindProperty("device");
            EditorGUILayout.PropertyField(device, Device);
            if (EditorGUILayout.DropdownButton(Known, FocusType.Keyboard))
            {
                ShowMenu("device", Devices);
            }
            if (device.stringValue.StartsWith("fake", StringComparison.Ordinal))
            {
                Draw("stroke", Stroke);
                if (EditorGUILayout.DropdownButton(new GUIContent("Known strokes"), FocusType.Keyboard))
                {
                    ShowMenu("stroke", Strokes);
                }
            }
            Draw("rate", Rate);
            Draw("workspaceScale", Scale);
            Draw("autostart", Autostart);
            Draw("retry", Retry);
            Draw("reconnect", Reconnect);
            Draw("clamp", Clamp);
            Draw("evenSensation", Even);
            Draw("responseFile", ResponseFile);
            Draw("paused", Paused);
            Draw("gain", Gain);
            Draw("addedForce", AddedForce);
            Draw("clutch", Clutch);
            Draw("sound", Sound);
            Draw("layers", Layers);
            DrawEvents(Events);
            serializedObject.ApplyModifiedProperties();
            DrawWarnings(((KnurlDevice)target).GetWarnings());
            if (!serializedObject.isEditingMultipleObjects && EditorApplication.isPlaying)
            {
                ShowState((KnurlDevice)target);
            }
        }

        void ShowMenu(string field, string[] values)
        {
            var menu = new GenericMenu();
            foreach (string value in values)
            {
                menu.AddItem(new GUIContent(value == "" ? "none" : value), false, () => Change(field, property => property.stringValue = value));
            }
            menu.ShowAsContext();
        }

        static void ShowState(KnurlDevice device)
        {
            if (!device.Running)
            {
                EditorGUILayout.HelpBox("It does not run; settings count from the next start on.", MessageType.Info);
                if (GUILayout.Button("Start"))
                {
                    device.StartDevice();
                }
                return;
            }
            EditorGUILayout.LabelField("Running", device.DeviceName);
            EditorGUILayout.LabelField("HIP (m)", Units.Place(device.HipPosition));
            EditorGUILayout.LabelField("Touched", device.Touched != null ? device.Touched.name : "nothing");
            EditorGUILayout.LabelField("Force (N)", Units.Number(device.Force.magnitude));
            EditorGUILayout.LabelField("Height", Units.Millimetres(device.Height));
            EditorGUILayout.LabelField("Temporal frequency (Hz)", Units.Number(device.TemporalFrequency));
            EditorGUILayout.LabelField("Ticks", device.Ticks + ", " + device.Overruns + " late");
            if (GUILayout.Button("Stop"))
            {
                device.StopDevice();
            }
        }
    }
}
