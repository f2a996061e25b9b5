// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    /// <summary>Makes the mesh of its MeshFilter felt, with every running <see cref="KnurlDevice"/>. The mesh is read
    /// when a device starts, or when the surface is enabled while one runs, at rest: skins and blend shapes are not
    /// followed; after a change of the mesh call <see cref="UpdateMesh"/>. It follows its transform, so that what slides
    /// under a finger is felt to slide: evenly, by the physics steps of a Rigidbody at or above it that is not
    /// interpolated, else by the frames. A scale is worked into the mesh, which is read again whenever the scale changes:
    /// cheap enough for now and then, not for every frame. Main thread.</summary>
    [AddComponentMenu("Knurl/Knurl Surface")]
    [DisallowMultipleComponent]
    [RequireComponent(typeof(MeshFilter))]
    public sealed class KnurlSurface : MonoBehaviour
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

        [SerializeField, Tooltip("Whether the nearest Rigidbody at or above it is pushed by the opposite of what the hand "
            + "feels.")]
        bool reaction;

        [SerializeField, Tooltip("Only devices feel it that have one of these layers too: a bit each.")]
        int layers = 1;

        /// <summary>A device touches it, see <see cref="KnurlDevice.contactStarted"/>.</summary>
        public KnurlTouchEvent touched = new KnurlTouchEvent();

        /// <summary>A device does not touch it any more, see <see cref="KnurlDevice.contactEnded"/>.</summary>
        public KnurlTouchEvent released = new KnurlTouchEvent();

        /// <summary>So many ridges passed under the finger since the last frame: for sounds.</summary>
        public KnurlRidgesEvent ridgesPassed = new KnurlRidgesEvent();

        // As counted in Made and Felt.
        [NonSerialized] KnurlGrating latestGrating;
        [NonSerialized] Vector3 latestAxis;
        [NonSerialized] bool latestDoubleSided, latestBoxCoordinates;

        /// <summary>How it feels; null: it cannot be felt.</summary>
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

        /// <summary>Whether it can be touched from behind as well. Default false.</summary>
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

        /// <summary>Whether ridges are laid out by positions in the mesh's own axes, each triangle's projected along the
        /// axis that its normal is closest to, instead of by UVs: for meshes with bad UVs. <see cref="Axis"/> has to be
        /// (0, 0, 0). Default false.</summary>
        public bool BoxCoordinates
        {
            get { return boxCoordinates; }
            set { boxCoordinates = value; Made++; Remember(); }
        }

        /// <summary>Whether the nearest Rigidbody at or above it is pushed by the opposite of what the hand feels. Its
        /// momentum is the hand's, so light bodies fly: some hundred grams and some drag keep them in hand. Default
        /// false.</summary>
        public bool Reaction
        {
            get { return reaction; }
            set { reaction = value; }
        }

        /// <summary>Only devices feel it that have one of these layers too (a bit each), see <see
        /// cref="KnurlDevice.Layers"/>. Default 1.</summary>
        public int Layers
        {
            get { return layers; }
            set { layers = value; }
        }

        /// <summary>How many triangles are felt with the first device that feels it; 0 while no running device
        /// does.</summary>
        public int TriangleCount
        {
            get
            {
                int count = 0;
                for (int i = 0; i < Registry.Devices.Count && count == 0; i++)
                {
                    count = Registry.Devices[i].CountTriangles(this);
                }
                return count;
            }
        }

        /// <summary>Whether it is what a device touched in the latest frame; of several surfaces in contact, the one
        /// that is pressed deepest.</summary>
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

        /// <summary>Counts what asks for its mesh to be read anew.</summary>
        internal int Made { get; private set; }

        /// <summary>Counts gratings that it was given.</summary>
        internal int Felt { get; private set; }

        /// <summary>Has the mesh read again in the next frame: after it was changed, or its MeshFilter was given another. A
        /// finger that rests on it stays in contact.</summary>
        public void UpdateMesh()
        {
            Made++;
        }

        /// <summary>Why it cannot be felt, or not as asked for: a sentence each. Empty where all is well. In play mode
        /// this includes what the running devices cannot do. Not for every frame.</summary>
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

        /// <summary>The mesh that is felt: null where its sentence says that there is none that can be; or null where
        /// it can.</summary>
        internal string FindMesh(out Mesh mesh)
        {
            var filter = GetComponent<MeshFilter>();
            var drawn = GetComponent<Renderer>();
            mesh = filter == null ? null : filter.sharedMesh;
            string refusal = mesh == null ? "Its MeshFilter has no mesh: there is nothing to feel."
                : drawn != null && drawn.isPartOfStaticBatch
                ? "Its mesh was merged with others into '" + mesh.name + "' by static batching: clear Batching Static "
                    + "among the static flags of its GameObject."
                : MeshReader.Refusal(mesh);
            mesh = refusal == null ? mesh : null;
            return refusal;
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
        }

        /// <summary>An animation writes fields behind the properties' back, each frame: only what is another counts, for
        /// the mesh is read anew for it.</summary>
        void OnDidApplyAnimationProperties()
        {
            bool isMadeAnew = latestDoubleSided != doubleSided || !Axes.IsSame(latestAxis, axis)
                || latestBoxCoordinates != boxCoordinates || (latestGrating == null) != (grating == null);
            Made += isMadeAnew ? 1 : 0;
            Felt += ReferenceEquals(latestGrating, grating) ? 0 : 1;
            Remember();
        }
    }
}
