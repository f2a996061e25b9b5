// A KnurlDevice's settings and its events. SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>A force-feedback device, or a simulated one, whose workspace lies in the scene. It runs a haptic
    /// thread, commonly a thousand times a second, that lets the device feel all <see cref="KnurlSurface"/> components;
    /// in play mode only. Where the object stands and how it is turned, there lies the device's workspace: x to the
    /// right, y up, the user looking along the object's z, origin at the object; the object's scale does not count. An
    /// object that moves takes the workspace and the hand with it, through what is in the way; one that jumps (faster
    /// than 10 m/s) touches nothing in between. A game that is paused, has a time scale of 0, hangs for more than a quarter of a second, or
    /// disables the device zeroes the force. All members: main thread.</summary>
    [AddComponentMenu("Knurl/Knurl Device")]
    [DefaultExecutionOrder(1000)] // last in a frame, so that what others have moved in it is followed
    [DisallowMultipleComponent]
    public sealed partial class KnurlDevice : MonoBehaviour
    {
        [SerializeField, Tooltip("Which device: auto (the first that is connected), fake (also fake:?key=value&...), touch, touch:NAME, falcon, rawhid, "
            + "rawhid:VID:PID; or mouse, which the game moves with MoveHip. Counts from the next start on, as do Stroke, "
            + "Rate, Reconnect and Clamp.")]
        string device = "fake";

        [SerializeField, Tooltip("What the fake device's simulated hand does over the first surface: line, sweep, "
            + "circle, press or rest. Empty: it stands still at the workspace's origin.")]
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

        [SerializeField, Tooltip("It feels the surfaces that have one of these layers too: a bit each.")]
        int layers = 1;

        /// <summary>A surface is touched; of several, the one pressed deepest. Null for a surface of <see
        /// cref="LoadGltf"/>. Told in LateUpdate; a touch shorter than a frame is told as well.</summary>
        public KnurlContactEvent contactStarted = new KnurlContactEvent();

        /// <summary>A surface is not the one touched any more: the finger left, something else is pressed deeper, the
        /// surface was disabled (then this comes at once) or the device stopped.</summary>
        public KnurlContactEvent contactEnded = new KnurlContactEvent();

        /// <summary>A button of the device (0: the first) was pressed or released, as of this frame.</summary>
        public KnurlButtonEvent buttonChanged = new KnurlButtonEvent();

        /// <summary>Something went wrong with the device or the haptic thread (1 to 31), or was well again (32 and
        /// above), with a sentence.</summary>
        public KnurlFaultEvent fault = new KnurlFaultEvent();

        /// <summary>A start by <see cref="Autostart"/> failed, with the error's code (<see cref="KnurlException.Code"/>) and
        /// sentence. Told once, however often <see cref="Retry"/> has it tried again.</summary>
        public KnurlFaultEvent startFailed = new KnurlFaultEvent();

        /// <summary>Which device: auto (the first that is connected), fake (also fake:?key=value&amp;...), touch, touch:NAME, falcon, rawhid,
        /// rawhid:VID:PID; or mouse, which the game moves with <see cref="MoveHip"/>. Default "fake". Counts from the
        /// next start on, as do Stroke, Rate, Reconnect and Clamp, and is checked there.</summary>
        public string Device
        {
            get { return device; }
            set { device = value; }
        }

        /// <summary>What the fake device's simulated hand does over the first surface: line, sweep, circle, press or
        /// rest. Empty, the default: it stands still at the workspace's origin.</summary>
        public string Stroke
        {
            get { return stroke; }
            set { stroke = value; }
        }

        /// <summary>Ticks a second (Hz), 100 to 10000. Default 1000.</summary>
        public float Rate
        {
            get { return rate; }
            set { rate = value; }
        }

        /// <summary>Metres of the scene per metre that the device moves, above 0. Walls feel stiffer by as much. May
        /// change while the device runs, as a zoom: the HIP moves towards this object or away from it, within 0.14 s for a
        /// factor of 2, and is held by what it meets. A scale that is set while <see cref="Clutch"/> is on is a zoom about
        /// the HIP, which stays where it is. Default 1.</summary>
        public float WorkspaceScale
        {
            get { return workspaceScale; }
            set { workspaceScale = value; }
        }

        /// <summary>Whether it starts in the first frame after it was enabled. Default true.</summary>
        public bool Autostart
        {
            get { return autostart; }
            set { autostart = value; }
        }

        /// <summary>Seconds after which a start by <see cref="Autostart"/> that failed is tried again, for players who plug
        /// their device in later; 0, the default: it is not.</summary>
        public float Retry
        {
            get { return retry; }
            set { retry = value; }
        }

        /// <summary>Whether a device that was lost is looked for again; otherwise losing it stops this component.
        /// Default true.</summary>
        public bool Reconnect
        {
            get { return reconnect; }
            set { reconnect = value; }
        }

        /// <summary>Whether walls and textures beyond what the device can do are felt at what it can. Default
        /// true.</summary>
        public bool Clamp
        {
            get { return clamp; }
            set { clamp = value; }
        }

        /// <summary>A pause of this device: the force goes to zero by a ramp, what is touched ends, and <see
        /// cref="HipPosition"/> goes on being told, for a menu; the motors cool. A time scale of 0 and an application in
        /// the background do the same. Default false. Counts at once.</summary>
        public bool Paused
        {
            get { return paused; }
            set
            {
                paused = value;
                Pause();
            }
        }

        /// <summary>How much of every force is sent, 0 to 1 (else set to the nearest of these), for a player's setting.
        /// Reached by a ramp. Default 1.</summary>
        public float Gain
        {
            get { return gain; }
            set { gain = value; }
        }

        /// <summary>A force of the game's own (N, global) that is added to what surfaces give until it is set anew. The
        /// sum grows no faster than the device's protections let it, is shortened to what its motors can do, and goes to
        /// zero in a pause and when the game hangs. Default zero.</summary>
        public Vector3 AddedForce
        {
            get { return addedForce; }
            set { addedForce = value; }
        }

        /// <summary>While it is on, nothing is felt and <see cref="HipPosition"/> stays, so that the hand can go back to
        /// where it has room; afterwards the point goes on from where it stayed. As with a mouse that is lifted. What
        /// was gained so goes with the object, and is forgotten at the next start. Default false.</summary>
        public bool Clutch
        {
            get { return clutch; }
            set { clutch = value; }
        }

        /// <summary>Whether what is felt is heard, by the <see cref="KnurlSound"/> of this object; one is added where there is
        /// none. Default false.</summary>
        public bool Sound
        {
            get { return sound; }
            set { sound = value; }
        }

        /// <summary>It feels the surfaces that have one of these layers too (a bit each), see <see
        /// cref="KnurlSurface.Layers"/>. Default 1.</summary>
        public int Layers
        {
            get { return layers; }
            set { layers = value; }
        }

        void Complain(string what, string sentence)
        {
            Debug.LogError("KnurlDevice '" + name + "', " + what + ": " + sentence, this);
        }
    }
}
