// What C# scripts see of Knurl's classes: KnurlDevice.Of(GetNode("KnurlDevice")). Written by csharp.py from the class
// reference. SPDX-License-Identifier: MIT
using System;
using Godot;

namespace Knurl
{
    /// <summary>How a surface feels: a grating of fine ridges on a wall.</summary>
    public sealed class KnurlGrating
    {
        /// <summary>The engine's object.</summary>
        public readonly Resource Object;

        KnurlGrating(Resource of) { Object = of; }

        /// <summary>A new one, to be put into the scene or given away.</summary>
        public static KnurlGrating Create() { return Of(ClassDB.Instantiate("KnurlGrating").AsGodotObject()); }

        /// <summary>What C# sees of an object: null where it is none of this class.</summary>
        public static KnurlGrating Of(GodotObject of)
        {
            return of != null && of.IsClass("KnurlGrating") ? new KnurlGrating((Resource)of) : null;
        }

        /// <summary>Half the height of the ridges from bottom to top, in metres.</summary>
        public double Amplitude { get { return Object.Get("amplitude").AsDouble(); } set { Object.Set("amplitude", value); } }

        /// <summary>Damping along the surface's normal, in N s/m.</summary>
        public double Damping { get { return Object.Get("damping").AsDouble(); } set { Object.Set("damping", value); } }

        /// <summary>Coefficient of dry friction across the surface.</summary>
        public double Friction { get { return Object.Get("friction").AsDouble(); } set { Object.Set("friction", value); } }

        /// <summary>How ridges are rendered. Default: as Bandlimited. S1 looks the height up at the position; S2 plays
        /// balanced events at the frequency that the velocity asks for; Bandlimited plays of the ridges' harmonics
        /// those that the update rate can carry, in step with the surface.</summary>
        public long Method { get { return Object.Get("method").AsInt64(); } set { Object.Set("method", value); } }

        /// <summary>Turns the grating's x and y counter-clockwise about the normal, in radians.</summary>
        public double Orientation { get { return Object.Get("orientation").AsDouble(); } set { Object.Set("orientation", value); } }

        /// <summary>Ridges per metre along the surface's x and y. (0, 0) is a smooth surface.</summary>
        public Vector2 SpatialFrequency { get { return Object.Get("spatial_frequency").AsVector2(); } set { Object.Set("spatial_frequency", value); } }

        /// <summary>Stiffness of the wall, in N/m. What a device can do is said by GetWarnings.</summary>
        public double Stiffness { get { return Object.Get("stiffness").AsDouble(); } set { Object.Set("stiffness", value); } }
    }

    /// <summary>Method of KnurlGrating.</summary>
    public enum KnurlGratingMethod : long
    {
        /// <summary>As METHOD_BANDLIMITED.</summary>
        Default = 0,

        /// <summary>The height at the position.</summary>
        S1 = 1,

        /// <summary>Balanced events at the frequency that the velocity asks for.</summary>
        S2 = 2,

        /// <summary>The harmonics that the update rate can carry, in step with the surface.</summary>
        Bandlimited = 3,
    }

    /// <summary>Makes the mesh of its parent felt.</summary>
    public sealed class KnurlSurface
    {
        /// <summary>The engine's object.</summary>
        public readonly Node3D Object;

        KnurlSurface(Node3D of) { Object = of; }

        /// <summary>A new one, to be put into the scene or given away.</summary>
        public static KnurlSurface Create() { return Of(ClassDB.Instantiate("KnurlSurface").AsGodotObject()); }

        /// <summary>What C# sees of an object: null where it is none of this class.</summary>
        public static KnurlSurface Of(GodotObject of)
        {
            return of != null && of.IsClass("KnurlSurface") ? new KnurlSurface((Node3D)of) : null;
        }

        /// <summary>The grating's x direction in the mesh's own axes. (0, 0, 0): the mesh's tangents, else its UVs,
        /// else as BoxCoordinates.</summary>
        public Vector3 Axis { get { return Object.Get("axis").AsVector3(); } set { Object.Set("axis", value); } }

        /// <summary>Whether ridges are laid out by positions in the mesh's own axes, each triangle's projected along
        /// the axis that its normal is closest to, instead of by UVs. For meshes with bad UVs; Axis has to be (0, 0,
        /// 0).</summary>
        public bool BoxCoordinates { get { return Object.Get("box_coordinates").AsBool(); } set { Object.Set("box_coordinates", value); } }

        /// <summary>Whether it can be touched from behind as well.</summary>
        public bool DoubleSided { get { return Object.Get("double_sided").AsBool(); } set { Object.Set("double_sided", value); } }

        /// <summary>Whether it can be felt. A hidden parent is felt, as its colliders would be.</summary>
        public bool Enabled { get { return Object.Get("enabled").AsBool(); } set { Object.Set("enabled", value); } }

        /// <summary>How it feels.</summary>
        public KnurlGrating Grating { get { return KnurlGrating.Of(Object.Get("grating").AsGodotObject()); } set { Object.Set("grating", value?.Object); } }

        /// <summary>Only devices feel it that have one of these layers too, see Layers.</summary>
        public long Layers { get { return Object.Get("layers").AsInt64(); } set { Object.Set("layers", value); } }

        /// <summary>Whether the nearest RigidBody3D above it is pushed by the opposite of what the hand feels. Its
        /// momentum is the hand's, so light bodies fly: some hundred grams and some damping keep them in
        /// hand.</summary>
        public bool Reaction { get { return Object.Get("reaction").AsBool(); } set { Object.Set("reaction", value); } }

        /// <summary>How many triangles are felt; 0 while the surface is in no running device's scene.</summary>
        public long GetTriangleCount() { return Object.Call("get_triangle_count").AsInt64(); }

        /// <summary>Why this surface cannot be felt, not as asked for, or not where it is drawn: a sentence each. Empty
        /// if all is well. In the editor it is held against every KnurlDevice of the scene, by what that device can do;
        /// in a game against those that run, which also print these lines when they start: each once, and that a
        /// surface is out of reach only if all are.</summary>
        public string[] GetWarnings() { return Object.Call("get_warnings").AsStringArray(); }

        /// <summary>Reads its parent's triangles again in the next frame. A MeshInstance3D needs no such
        /// call.</summary>
        public void UpdateMesh() { Object.Call("update_mesh"); }

        /// <summary>Whether it is what a device touched in the latest frame; of several surfaces in contact, the one
        /// that is pressed deepest.</summary>
        public bool IsTouched() { return Object.Call("is_touched").AsBool(); }

        /// <summary>A device does not touch it any more, see ContactEnded. Null for a device that is freed already. A
        /// surface that is freed while it is touched emits nothing more.</summary>
        public void OnReleased(Action<KnurlDevice> handler)
        {
            Object.Connect("released", Callable.From((GodotObject device) => handler(KnurlDevice.Of(device))));
        }

        /// <summary>So many ridges passed under the finger since the last frame: for sounds.</summary>
        public void OnRidgesPassed(Action<KnurlDevice, long> handler)
        {
            Object.Connect("ridges_passed", Callable.From((GodotObject device, long count) => handler(KnurlDevice.Of(device), count)));
        }

        /// <summary>A device touches it, see ContactStarted.</summary>
        public void OnTouched(Action<KnurlDevice> handler)
        {
            Object.Connect("touched", Callable.From((GodotObject device) => handler(KnurlDevice.Of(device))));
        }
    }

    /// <summary>A force-feedback device, or a simulated one, whose workspace lies in the scene.</summary>
    public sealed class KnurlDevice
    {
        /// <summary>The engine's object.</summary>
        public readonly Node3D Object;

        KnurlDevice(Node3D of) { Object = of; }

        /// <summary>A new one, to be put into the scene or given away.</summary>
        public static KnurlDevice Create() { return Of(ClassDB.Instantiate("KnurlDevice").AsGodotObject()); }

        /// <summary>What C# sees of an object: null where it is none of this class.</summary>
        public static KnurlDevice Of(GodotObject of)
        {
            return of != null && of.IsClass("KnurlDevice") ? new KnurlDevice((Node3D)of) : null;
        }

        /// <summary>A force of the game's own, in N, global, that is added to what surfaces give until it is set anew.
        /// The sum grows no faster than the device's protections let it, is shortened to what its motors can do, and
        /// goes to zero in a pause and when the game hangs.</summary>
        public Vector3 AddedForce { get { return Object.Get("added_force").AsVector3(); } set { Object.Set("added_force", value); } }

        /// <summary>Whether it starts in its first frame in the tree.</summary>
        public bool Autostart { get { return Object.Get("autostart").AsBool(); } set { Object.Set("autostart", value); } }

        /// <summary>Whether walls and textures beyond what the device can do are felt at what it can.</summary>
        public bool Clamp { get { return Object.Get("clamp").AsBool(); } set { Object.Set("clamp", value); } }

        /// <summary>The device's buttons that are pressed, a bit each.</summary>
        public long Buttons { get { return Object.Get("buttons").AsInt64(); } }

        /// <summary>While it is on, nothing is felt and HipPosition stays, so that the hand can go back to where it has
        /// room; afterwards the point goes on from where it stayed. As with a mouse that is lifted. What was gained so
        /// goes with the node, and is forgotten at the next start.</summary>
        public bool Clutch { get { return Object.Get("clutch").AsBool(); } set { Object.Set("clutch", value); } }

        /// <summary>How deep the device is in what it touches, in metres.</summary>
        public double Depth { get { return Object.Get("depth").AsDouble(); } }

        /// <summary>Which device: auto (the first that is connected), fake (also fake:?key=value&amp;...), touch,
        /// touch:NAME, falcon, rawhid, rawhid:VID:PID; or mouse, which the game moves with MoveHip. Counts from the
        /// next start on, as do Rate, Stroke, Reconnect and Clamp.</summary>
        public string Device { get { return Object.Get("device").AsString(); } set { Object.Set("device", value); } }

        /// <summary>What the running device is, for people.</summary>
        public string DeviceName { get { return Object.Get("device_name").AsString(); } }

        /// <summary>The latest force, in N, global.</summary>
        public Vector3 Force { get { return Object.Get("force").AsVector3(); } }

        /// <summary>How much of every force is sent: 0 to 1, for a player's setting. Reached by a ramp.</summary>
        public double Gain { get { return Object.Get("gain").AsDouble(); } set { Object.Set("gain", value); } }

        /// <summary>The grating's height under the finger in the latest tick, in metres.</summary>
        public double Height { get { return Object.Get("height").AsDouble(); } }

        /// <summary>The haptic interaction point: where the device is, global.</summary>
        public Vector3 HipPosition { get { return Object.Get("hip_position").AsVector3(); } }

        /// <summary>Whether anything is touched.</summary>
        public bool InContact { get { return Object.Get("in_contact").AsBool(); } }

        /// <summary>It feels the surfaces that have one of these layers too, see Layers.</summary>
        public long Layers { get { return Object.Get("layers").AsInt64(); } set { Object.Set("layers", value); } }

        /// <summary>Ticks that came late.</summary>
        public long Overruns { get { return Object.Get("overruns").AsInt64(); } }

        /// <summary>A pause of this device alone: the force goes to zero by a ramp, what is touched ends, and
        /// HipPosition goes on being told, for a menu. A paused tree does the same to a device that it stops; one that
        /// processes always feels on unless this is set.</summary>
        public bool Paused { get { return Object.Get("paused").AsBool(); } set { Object.Set("paused", value); } }

        /// <summary>The point of the surface that holds the haptic interaction point, global: where a cursor is
        /// drawn.</summary>
        public Vector3 ProxyPosition { get { return Object.Get("proxy_position").AsVector3(); } }

        /// <summary>Ticks a second.</summary>
        public double Rate { get { return Object.Get("rate").AsDouble(); } set { Object.Set("rate", value); } }

        /// <summary>Whether a device that was lost is looked for again; otherwise losing it stops this node.</summary>
        public bool Reconnect { get { return Object.Get("reconnect").AsBool(); } set { Object.Set("reconnect", value); } }

        /// <summary>Seconds after which a start by Autostart that failed is tried again; 0: it is not. For players who
        /// plug their device in later.</summary>
        public double Retry { get { return Object.Get("retry").AsDouble(); } set { Object.Set("retry", value); } }

        /// <summary>Whether the haptic thread runs.</summary>
        public bool Running { get { return Object.Get("running").AsBool(); } }

        /// <summary>Whether what is felt is heard: the surface under the HIP, from the motion between ticks, so that it
        /// is there above what a hand feels as well. It is played by the child node Sound: an AudioStreamPlayer that
        /// the device makes, or one of the game's own, also an AudioStreamPlayer2D or AudioStreamPlayer3D, with its
        /// volume, bus and mix target. The signal is mono, exactly 0 at rest, and comes 16 ms after the motion plus the
        /// engine's own latency.</summary>
        public bool Sound { get { return Object.Get("sound").AsBool(); } set { Object.Set("sound", value); } }

        /// <summary>What the fake device's simulated hand does over the first surface: line, sweep, circle, press or
        /// rest. Empty: it stands still at the workspace's origin.</summary>
        public string Stroke { get { return Object.Get("stroke").AsString(); } set { Object.Set("stroke", value); } }

        /// <summary>How the stylus is turned, global, to draw one: contact is a point's. The identity with a device
        /// that does not measure it.</summary>
        public Quaternion StylusRotation { get { return Object.Get("stylus_rotation").AsQuaternion(); } }

        /// <summary>Ridges a second that the motion asks for, in Hz.</summary>
        public double TemporalFrequency { get { return Object.Get("temporal_frequency").AsDouble(); } }

        /// <summary>Ticks since the start.</summary>
        public long Ticks { get { return Object.Get("ticks").AsInt64(); } }

        /// <summary>How fast the haptic interaction point moves, in m/s, global.</summary>
        public Vector3 Velocity { get { return Object.Get("velocity").AsVector3(); } }

        /// <summary>Metres of the scene per metre that the device moves. Walls feel stiffer by as much. May change
        /// while the device runs, as a zoom: the HIP moves towards this node or away from it, within 0.14 s for a
        /// factor of 2, and is held by what it meets. A scale that is set while Clutch is on is a zoom about the HIP,
        /// which stays where it is.</summary>
        public double WorkspaceScale { get { return Object.Get("workspace_scale").AsDouble(); } set { Object.Set("workspace_scale", value); } }

        /// <summary>The point where a straight line (global) first goes through what this device feels, by its
        /// triangles and as it stands now, with no part of the engine's physics: position, normal (outward), distance
        /// (m) and surface (the KnurlSurface; null for one of LoadGltf). A surface that is not double-sided is hit from
        /// its front only. Empty if nothing is hit or the device does not run.</summary>
        public Godot.Collections.Dictionary CastRay(Vector3 from, Vector3 to) { return Object.Call("cast_ray", from, to).AsGodotDictionary(); }

        /// <summary>The latest ticks, oldest first, at most 8192: two numbers each, the grating's height in metres and
        /// the force along the normal in newtons.</summary>
        public float[] GetHistory(long count) { return Object.Call("get_history", count).AsFloat32Array(); }

        /// <summary>Everything that is counted: ticks, overruns, times in microseconds, limits that took hold, memory.
        /// Only running while it does not run. For people who look for what is wrong; not for every frame.</summary>
        public Godot.Collections.Dictionary GetStatus() { return Object.Call("get_status").AsGodotDictionary(); }

        /// <summary>The KnurlSurface that is touched, of several the one pressed deepest; null where none is, or one of
        /// LoadGltf.</summary>
        public KnurlSurface GetTouchedSurface() { return KnurlSurface.Of(Object.Call("get_touched_surface").AsGodotObject()); }

        /// <summary>What is wrong with how it is set up: a sentence each. Empty where all is well.</summary>
        public string[] GetWarnings() { return Object.Call("get_warnings").AsStringArray(); }

        /// <summary>The devices that are connected, and each kind of which none is: a Dictionary each with device (what
        /// to set Device to), name, usable and, where it is not, reason: why, and what helps. Looks at the machine's
        /// USB devices: some milliseconds.</summary>
        public Godot.Collections.Array ListDevices() { return Object.Call("list_devices").AsGodotArray(); }

        /// <summary>Adds all surfaces that are tagged in the extras of a .gltf or .glb file, at the scene's origin,
        /// without any node; they stay as long as this node. Returns how many there were, or -1 after an error. The
        /// file has to lie on the disk, also in an exported game.</summary>
        public long LoadGltf(string path) { return Object.Call("load_gltf", path).AsInt64(); }

        /// <summary>Moves the haptic interaction point of the device mouse. What comes in steps is smoothed: it lags 25
        /// ms behind.</summary>
        public void MoveHip(Vector3 globalPosition) { Object.Call("move_hip", globalPosition); }

        /// <summary>What a device that does not run would play along a path, as fast as the machine can: rows of time
        /// (s), x, y, z (m, global), ascending, interpolated. Returns the force of every tick, x, y, z in N, global.
        /// Needs a fake device.</summary>
        public double[] PlayTrace(double[] rows, long ticks) { return Object.Call("play_trace", rows, ticks).AsFloat64Array(); }

        /// <summary>Opens the device and starts its loop. Returns OK, or an error after printing the reason.</summary>
        public long Start() { return Object.Call("start").AsInt64(); }

        /// <summary>Adds a square wave to the force for Duration seconds, as a cue: a Vibration of Frequency (Hz, 0.1
        /// to half of Rate) and Amplitude (N, half peak to peak) along Direction (global), in place of one that plays.
        /// A duration of 0 ends that. Bounded like AddedForce.</summary>
        public void Vibrate(long method, double frequency, double amplitude, double duration, Vector3 direction) { Object.Call("vibrate", method, frequency, amplitude, duration, direction); }

        /// <summary>Zeroes the force and closes the device. Twice is fine.</summary>
        public void Stop() { Object.Call("stop"); }

        /// <summary>A button of the device was pressed or released, as of this frame.</summary>
        public void OnButtonChanged(Action<long, bool> handler)
        {
            Object.Connect("button_changed", Callable.From((long index, bool pressed) => handler(index, pressed)));
        }

        /// <summary>A surface is not the one touched any more: the finger left, something else is pressed deeper, the
        /// surface left the tree or was freed, a pause began, or the device stopped. Null for a surface of LoadGltf,
        /// and for one that is freed already. From Stop it comes at once, else at the end of the frame.</summary>
        public void OnContactEnded(Action<KnurlSurface> handler)
        {
            Object.Connect("contact_ended", Callable.From((GodotObject surface) => handler(KnurlSurface.Of(surface))));
        }

        /// <summary>A surface is touched; of several, the one pressed deepest. Null for a surface of
        /// LoadGltf.</summary>
        public void OnContactStarted(Action<KnurlSurface> handler)
        {
            Object.Connect("contact_started", Callable.From((GodotObject surface) => handler(KnurlSurface.Of(surface))));
        }

        /// <summary>Something went wrong with the device or the haptic thread (1 to 31), or was well again (32 and
        /// above).</summary>
        public void OnFault(Action<long, string> handler)
        {
            Object.Connect("fault", Callable.From((long code, string text) => handler(code, text)));
        }

        /// <summary>A start by Autostart failed, with an Error and a sentence for people. Told once, however often
        /// Retry has it tried again.</summary>
        public void OnStartFailed(Action<long, string> handler)
        {
            Object.Connect("start_failed", Callable.From((long error, string text) => handler(error, text)));
        }
    }

    /// <summary>Vibration of KnurlDevice.</summary>
    public enum KnurlDeviceVibration : long
    {
        /// <summary>A sampled square wave: its mean need not be zero.</summary>
        T1 = 17,

        /// <summary>Two even periods mixed: the frequency is exact.</summary>
        T2 = 18,

        /// <summary>Whole events whose impulse is zero: it does not push the hand away.</summary>
        T3 = 19,
    }

    /// <summary>Fault of KnurlDevice.</summary>
    public enum KnurlDeviceFault : long
    {
        /// <summary>The device is gone: unplugged or switched off.</summary>
        Lost = 1,

        /// <summary>No position from the device for too long.</summary>
        Silent = 2,

        /// <summary>An incomplete or corrupt message was discarded.</summary>
        Corrupt = 3,

        /// <summary>A position was not a number.</summary>
        NotFinite = 4,

        /// <summary>The position jumped further than a hand can move.</summary>
        Jump = 5,

        /// <summary>The last force was too old to keep playing.</summary>
        Late = 6,

        /// <summary>Ticks came late; reported once for several in a row.</summary>
        Overrun = 7,

        /// <summary>The haptic thread stalled.</summary>
        Watchdog = 8,

        /// <summary>No heartbeat from the game.</summary>
        Heartbeat = 9,

        /// <summary>The device refused the force.</summary>
        Refused = 10,

        /// <summary>The device is not homed.</summary>
        Uncalibrated = 11,

        /// <summary>The guard process ended; if this process is killed now, the last force keeps playing.</summary>
        Unguarded = 12,

        /// <summary>The loop did not run for a while: the program or the machine was paused.</summary>
        Gap = 13,

        /// <summary>The handle does not follow the force along x: a motor is wired or signed backwards.</summary>
        BackwardsX = 14,

        /// <summary>The handle does not follow the force along y: a motor is wired or signed backwards.</summary>
        BackwardsY = 15,

        /// <summary>The handle does not follow the force along z: a motor is wired or signed backwards.</summary>
        BackwardsZ = 16,

        /// <summary>The device has switched its forces off: its force button, its own limit or watchdog, no power
        /// supply. The message tells which.</summary>
        ForceOff = 17,

        /// <summary>No fault: the force ramps up again.</summary>
        Resumed = 32,

        /// <summary>No fault: the device is connected again.</summary>
        Reconnected = 33,
    }
}
