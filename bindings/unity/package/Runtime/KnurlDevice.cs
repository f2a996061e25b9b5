// A KnurlDevice's settings and its events. SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>A force-feedback device, real or simulated, with its workspace in the scene. In play mode it runs a
    /// haptic thread, usually at 1000 Hz, so that the device feels all <see cref="KnurlSurface"/> components. The
    /// workspace has the object's position and rotation, but not its scale: x to the right, y up, the user looking
    /// along the object's z, origin at the object. If the object moves, the workspace and the hand move with it and
    /// touch surfaces on the path; above 10 m/s it jumps and touches nothing in between. The force goes to zero if the
    /// game is paused, has a time scale of 0, hangs for more than 0.25 s, or disables the device. All members: main
    /// thread.</summary>
    [AddComponentMenu("Knurl/Knurl Device")]
    [HelpURL(Manual.Device)]
    [DefaultExecutionOrder(1000)] // last in a frame, after other scripts have moved objects
    [DisallowMultipleComponent]
    public sealed partial class KnurlDevice : MonoBehaviour
    {
        [SerializeField, Tooltip("Which device: auto (the first that is connected), fake (also fake:?key=value&...), touch, touch:NAME, falcon, rawhid, "
            + "rawhid:VID:PID; or mouse, which the game moves with MoveHip. Counts from the next start on, as do Stroke, "
            + "Rate, Reconnect and Clamp.")]
        string device = "fake";

        [SerializeField, Tooltip("What the fake device's simulated hand does over the first surface: line, sweep, "
            + "circle, press or rest. Empty: it stands still at the workspace's origin. Other devices have no use for it.")]
        string stroke = "";

        [SerializeField, Min(0f), Tooltip("Ticks a second, 100 to 10000. Hz")]
        float rate = 1000f;

        [SerializeField, Min(0f), Tooltip("Metres of the scene per metre that the device moves, above 0. Walls feel "
            + "stiffer by as much. Counts at once.")]
        float workspaceScale = 1f;

        [SerializeField, Tooltip("Whether it starts in its first frame.")]
        bool autostart = true;

        [SerializeField, Min(0f), Tooltip("Seconds after which a start by Autostart that failed is tried again; 0: it is "
            + "not. s")]
        float retry;

        [SerializeField, Tooltip("Whether a device that was lost is looked for again; otherwise losing it stops this "
            + "component.")]
        bool reconnect = true;

        [SerializeField, Tooltip("Whether walls and textures beyond what the device can do are felt at what it can.")]
        bool clamp = true;

        [SerializeField, Tooltip("Lowers the amplitude of gratings at some speeds, so that ridges are equally strong from 25 to "
            + "300 per second. Counts from the next start on.")]
        bool evenSensation;

        [SerializeField, Tooltip("The device's measured response for Even Sensation, a CSV file that knurl sweep writes. None: "
            + "a model of the device in a hand.")]
        TextAsset responseFile;

        [SerializeField, Tooltip("A pause of this device: nothing is felt, and where it is goes on being told. Counts at "
            + "once.")]
        bool paused;

        [SerializeField, Range(0f, 1f), Tooltip("How much of every force is sent, 0 to 1: for a player's setting. Counts at "
            + "once.")]
        float gain = 1f;

        [SerializeField, Tooltip("A force of the game's own that is added to what surfaces give, global. N")]
        Vector3 addedForce;

        [SerializeField, Tooltip("While it is on, nothing is felt and the HIP stays, so that the hand can go back to where "
            + "it has room.")]
        bool clutch;

        [SerializeField, Tooltip("Whether what is felt is heard, by the Knurl Sound component of this object; one is added "
            + "where there is none. Counts at once.")]
        bool sound;

        [SerializeField, Layers, Tooltip("It feels the surfaces that have one of these layers too.")]
        int layers = 1;

        /// <summary>Invoked when a surface is touched; the one pressed deepest if there are several. Null for a surface
        /// of <see cref="LoadGltf"/>. Invoked in LateUpdate, also for a touch shorter than a frame.</summary>
        public KnurlContactEvent contactStarted = new KnurlContactEvent();

        /// <summary>Invoked when a surface is no longer the touched one: contact ended, another surface is pressed
        /// deeper, the surface was disabled (then immediately) or the device stopped.</summary>
        public KnurlContactEvent contactEnded = new KnurlContactEvent();

        /// <summary>Invoked when a button of the device (0: the first) was pressed or released since the last
        /// frame.</summary>
        public KnurlButtonEvent buttonChanged = new KnurlButtonEvent();

        /// <summary>Invoked on a fault of the device or the haptic thread (1 to 31) and on recovery (32 and above),
        /// with a message.</summary>
        public KnurlFaultEvent fault = new KnurlFaultEvent();

        /// <summary>Invoked when a start by <see cref="Autostart"/> fails, with the error's code (<see
        /// cref="KnurlException.Code"/>) and message. Invoked once, not for each attempt of <see
        /// cref="Retry"/>.</summary>
        public KnurlFaultEvent startFailed = new KnurlFaultEvent();

        /// <summary>Which device: auto (the first that is connected), fake (also fake:?key=value&amp;...), touch,
        /// touch:NAME, falcon, rawhid,
        /// rawhid:VID:PID; or mouse, which the game moves with <see cref="MoveHip"/>. Default "fake". Takes effect, and
        /// is checked, at the next start, like Stroke, Rate, Reconnect and Clamp.</summary>
        public string Device
        {
            get { return device; }
            set { device = value; }
        }

        /// <summary>Path of the fake device's simulated hand over the first surface: line, sweep, circle, press or
        /// rest. Empty: it rests at the workspace's origin. Default: empty, and sweep for a component that is added in the
        /// editor. Other devices ignore it.</summary>
        public string Stroke
        {
            get { return stroke; }
            set { stroke = value; }
        }

        /// <summary>Ticks per second (Hz), 100 to 10000. Default 1000.</summary>
        public float Rate
        {
            get { return rate; }
            set { rate = value; }
        }

        /// <summary>Metres in the scene per metre of the device's motion, above 0. Walls feel stiffer by the same
        /// factor. It can change while the device runs, as a zoom: the HIP moves towards this object or away from it,
        /// within 0.14 s for a factor of 2, and surfaces stop it. If it is set while <see cref="Clutch"/> is on, the
        /// zoom is about the HIP, which stays in place. Default 1.</summary>
        public float WorkspaceScale
        {
            get { return workspaceScale; }
            set { workspaceScale = value; }
        }

        /// <summary>True, the default: it starts in the first frame after it was enabled.</summary>
        public bool Autostart
        {
            get { return autostart; }
            set { autostart = value; }
        }

        /// <summary>Seconds between attempts if a start by <see cref="Autostart"/> fails, for players who plug their
        /// device in later; 0, the default: no further attempts.</summary>
        public float Retry
        {
            get { return retry; }
            set { retry = value; }
        }

        /// <summary>True, the default: a lost device is reopened once it is back; otherwise its loss stops this
        /// component.</summary>
        public bool Reconnect
        {
            get { return reconnect; }
            set { reconnect = value; }
        }

        /// <summary>True, the default: stiffness and amplitude are limited to values that the device can
        /// render.</summary>
        public bool Clamp
        {
            get { return clamp; }
            set { clamp = value; }
        }

        /// <summary>Whether the amplitude of gratings is lowered at some speeds, so that ridges are equally strong from 25 to
        /// 300 per second: by <see cref="ResponseFile"/> or, without one, by the device's mass and friction in a model of a hand.
        /// Has no effect with a mouse. Counts from the next start on. Default false.</summary>
        public bool EvenSensation
        {
            get { return evenSensation; }
            set { evenSensation = value; }
        }

        /// <summary>The device's measured response for <see cref="EvenSensation"/>, a CSV file that <c>knurl sweep</c> writes.
        /// Null, the default: none. Counts from the next start on.</summary>
        public TextAsset ResponseFile
        {
            get { return responseFile; }
            set { responseFile = value; }
        }

        /// <summary>Pauses this device: the force ramps down to zero, contacts end, the motors cool, and <see
        /// cref="HipPosition"/> is still updated, for example for a menu. A time scale of 0 and an application in the
        /// background do the same. Takes effect immediately. Default false.</summary>
        public bool Paused
        {
            get { return paused; }
            set
            {
                paused = value;
                Pause();
            }
        }

        /// <summary>Factor on every force, clamped to 0 to 1, for a player's setting. Changes are ramped. Default
        /// 1.</summary>
        public float Gain
        {
            get { return gain; }
            set { gain = value; }
        }

        /// <summary>A force from the game (N, global), added to the surfaces' forces until it is changed. The sum is
        /// subject to the device's slew limit and maximum force, and goes to zero in a pause and if the game hangs.
        /// Default zero.</summary>
        public Vector3 AddedForce
        {
            get { return addedForce; }
            set { addedForce = value; }
        }

        /// <summary>While true, nothing is felt and <see cref="HipPosition"/> stays, so that the hand can move back to
        /// the middle of its range, as with a mouse that is lifted. Afterwards the point follows the hand again from
        /// the same place. The offset moves with the object and is reset by the next start. Default false.</summary>
        public bool Clutch
        {
            get { return clutch; }
            set { clutch = value; }
        }

        /// <summary>True: the touched texture can be heard, by the <see cref="KnurlSound"/> of this object, which is
        /// added if it is missing. Default false.</summary>
        public bool Sound
        {
            get { return sound; }
            set { sound = value; }
        }

        /// <summary>It feels surfaces that share at least one of these layers (one bit each), see <see
        /// cref="KnurlSurface.Layers"/>. Default 1.</summary>
        public int Layers
        {
            get { return layers; }
            set { layers = value; }
        }

        /// <summary>In the editor, for a new component: something is felt at once.</summary>
        void Reset()
        {
            stroke = "sweep";
        }

        void Complain(string what, string sentence)
        {
            Debug.LogError("KnurlDevice '" + name + "', " + what + ": " + sentence, this);
        }
    }
}
