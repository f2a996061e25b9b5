// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    /// <summary>Makes the mesh of its MeshFilter touchable with every running <see cref="KnurlDevice"/>. The mesh is
    /// read in its rest pose, without skins and blend shapes, when a device starts or the surface is enabled; call <see
    /// cref="UpdateMesh"/> after a change. The surface follows its transform, so an object that slides under a finger
    /// is felt to slide. Its motion is interpolated between the frames, or between physics steps if it belongs to a
    /// Rigidbody without interpolation. Scale is baked into the mesh, which is read again when the scale changes, in
    /// at most a fiftieth of the game's time; in between it only moves. Main thread.</summary>
    [AddComponentMenu("Knurl/Knurl Surface")]
    [HelpURL(Manual.Surface)]
    [DisallowMultipleComponent]
    [RequireComponent(typeof(MeshFilter))]
    public sealed partial class KnurlSurface : MonoBehaviour
    {
        [SerializeField, Tooltip("How it feels.")]
        KnurlGrating grating;

        [SerializeField, Tooltip("Whether it can be touched from behind as well.")]
        bool doubleSided;

        [SerializeField, Tooltip("The grating's x direction in the mesh's own axes, of any length. (0, 0, 0): the "
            + "mesh's UVs, else its tangents, else box coordinates.")]
        Vector3 axis;

        [SerializeField, Tooltip("Whether ridges are laid out by positions in the mesh's own axes, each triangle's projected "
            + "along the axis that its normal is closest to, instead of by UVs. The axis has to be (0, 0, 0).")]
        bool boxCoordinates;

        [SerializeField, Tooltip("Auto: felt as smooth as it looks, by the mesh's normals. Off: as its triangles. On: smooth, "
            + "with computed normals if the mesh has none.")]
        SurfaceSmoothness smooth;

        [SerializeField, Tooltip("Whether the nearest Rigidbody at or above it is pushed by the opposite of what the hand "
            + "feels.")]
        bool reaction;

        [SerializeField, Layers, Tooltip("Only devices feel it that have one of these layers too.")]
        int layers = 1;

        /// <summary>Invoked when a device touches it, see <see cref="KnurlDevice.contactStarted"/>.</summary>
        public KnurlTouchEvent touched = new KnurlTouchEvent();

        /// <summary>Invoked when a device no longer touches it, see <see cref="KnurlDevice.contactEnded"/>.</summary>
        public KnurlTouchEvent released = new KnurlTouchEvent();

        /// <summary>Invoked with the number of ridges that passed under the finger since the last frame, for
        /// sounds.</summary>
        public KnurlRidgesEvent ridgesPassed = new KnurlRidgesEvent();

        // As of the last counts in Made and Felt.
        [NonSerialized] KnurlGrating latestGrating;
        [NonSerialized] Vector3 latestAxis;
        [NonSerialized] bool latestDoubleSided, latestBoxCoordinates;
        [NonSerialized] SurfaceSmoothness latestSmooth;

        /// <summary>Texture and wall of the surface; null: it cannot be felt.</summary>
        public KnurlGrating Grating
        {
            get { return grating; }
            set
            {
                Made += (grating == null) != (value == null) ? 1 : 0;
                Felt++;
                grating = value;
                Remember();
            }
        }

        /// <summary>True: it can be touched from behind as well. Default false.</summary>
        public bool DoubleSided
        {
            get { return doubleSided; }
            set { doubleSided = value; Made++; Remember(); }
        }

        /// <summary>The grating's x direction in the mesh's own axes, of any length. (0, 0, 0), the default: the mesh's
        /// UVs, else its tangents, else as <see cref="BoxCoordinates"/>.</summary>
        public Vector3 Axis
        {
            get { return axis; }
            set { axis = value; Made++; Remember(); }
        }

        /// <summary>True: ridges follow positions in the mesh's own axes instead of UVs: each triangle is projected
        /// along the axis closest to its normal. For meshes with bad UVs; <see cref="Axis"/> must be (0, 0, 0). Default
        /// false.</summary>
        public bool BoxCoordinates
        {
            get { return boxCoordinates; }
            set { boxCoordinates = value; Made++; Remember(); }
        }

        /// <summary>Whether the mesh is felt as a smooth surface or as its triangles. Default <see
        /// cref="SurfaceSmoothness.Auto"/>.</summary>
        public SurfaceSmoothness Smooth
        {
            get { return smooth; }
            set { smooth = value; Made++; Remember(); }
        }

        /// <summary>True: the nearest Rigidbody at or above it gets the opposite of the hand's force. It receives the
        /// hand's full momentum, so very light bodies fly away: use some hundred grams and some drag. Default
        /// false.</summary>
        public bool Reaction
        {
            get { return reaction; }
            set { reaction = value; }
        }

        /// <summary>Only devices that share at least one of these layers (one bit each) feel it, see <see
        /// cref="KnurlDevice.Layers"/>. Default 1.</summary>
        public int Layers
        {
            get { return layers; }
            set { layers = value; }
        }

        /// <summary>True if a device touched it in the last frame. If several surfaces are in contact, only the one
        /// pressed deepest counts.</summary>
        public bool IsTouched
        {
            get
            {
                bool isTouched = false;
                for (int i = 0; i < Registry.Devices.Count; i++)
                {
                    isTouched |= ReferenceEquals(Registry.Devices[i].Touched, this);
                }
                return isTouched;
            }
        }

        /// <summary>Counts changes after which its mesh must be read again.</summary>
        internal int Made { get; private set; }

        /// <summary>Counts changes of the property Grating.</summary>
        internal int Felt { get; private set; }

        /// <summary>Why it cannot be felt or differs from its settings: one sentence each. Empty if there are no
        /// problems. In play mode this includes the limits of the running devices. Not for every frame.</summary>
        public string[] GetWarnings()
        {
            var warnings = new List<string>();
            Mesh mesh;
            string refusal = FindMesh(out mesh);
            string omission = refusal == null ? MeshReader.Omission(mesh) : null;
            if (refusal != null)
            {
                warnings.Add(refusal);
            }
            if (omission != null)
            {
                warnings.Add(omission);
            }
            if (grating == null)
            {
                warnings.Add("It has no grating: nothing says how it feels.");
            }
            if (IsFlat())
            {
                warnings.Add("It is scaled to nothing.");
            }
            bool isOnLayer = Registry.Devices.Count == 0;
            for (int i = 0; i < Registry.Devices.Count; i++)
            {
                Registry.Devices[i].Explain(this, warnings);
                isOnLayer |= (Registry.Devices[i].Layers & layers) != 0;
            }
            if (!isOnLayer)
            {
                warnings.Add("No running KnurlDevice has one of its layers.");
            }
            return warnings.ToArray();
        }

        internal bool WasChangedSince(long gratingsSeen)
        {
            return (object)grating != null && grating.Version > gratingsSeen;
        }

        unsafe bool IsFlat()
        {
            Matrix4x4 matrix = transform.localToWorldMatrix;
            double* rows = stackalloc double[12];
            knurl_session_pose pose;
            Axes.ToScene(&matrix, rows);
            return Library.Check() == null && NativeMethods.knurl_session_split_pose(rows, &pose) == 0;
        }

        void OnEnable()
        {
            Remember();
            Registry.Add(this);
        }

        void OnDisable()
        {
            Registry.Remove(this);
        }

        void OnValidate()
        {
            Made++;
            Felt++;
            Remember();
        }

        void Remember()
        {
            latestGrating = grating;
            latestAxis = axis;
            latestDoubleSided = doubleSided;
            latestBoxCoordinates = boxCoordinates;
            latestSmooth = smooth;
        }

        /// <summary>An animation writes the fields directly, in each frame: compare them, because a change reads the
        /// mesh again.</summary>
        void OnDidApplyAnimationProperties()
        {
            bool isMadeAnew = latestDoubleSided != doubleSided || !Axes.IsSame(latestAxis, axis)
                || latestBoxCoordinates != boxCoordinates || latestSmooth != smooth || (latestGrating == null) != (grating == null);
            Made += isMadeAnew ? 1 : 0;
            Felt += ReferenceEquals(latestGrating, grating) ? 0 : 1;
            Remember();
        }
    }
}
