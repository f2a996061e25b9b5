// Test-only stand-in, never shipped.
using System.Collections;
using System.Collections.Generic;

namespace UnityEngine
{
    /// Faithful: the maths of hierarchies in float, with Unity's rotation and lossyScale if parents scale unevenly
    /// (the product of the rotations); hasChanged, children enumerated in their state at each step. Not: sibling order,
    /// events, an error for a parent that is a child.
    public class Transform : Component, IEnumerable
    {
        internal readonly List<Transform> children = new List<Transform>();
        Transform above;
        Vector3 ownPosition;
        Quaternion ownRotation = Quaternion.identity;
        Vector3 ownScale = Vector3.one;
        Matrix4x4 kept;
        bool isKept;

        protected internal Transform() { }

        void Touch()
        {
            isKept = false;
            for (int i = 0; i < children.Count; i++)
            {
                children[i].Touch();
            }
        }

        public Vector3 localPosition
        {
            get { Living(); return ownPosition; }
            set { Living(); ownPosition = value; Touch(); }
        }

        public Quaternion localRotation
        {
            get { Living(); return ownRotation; }
            set { Living(); ownRotation = value.normalized; Touch(); }
        }

        public Vector3 localScale
        {
            get { Living(); return ownScale; }
            set { Living(); ownScale = value; Touch(); }
        }

        public Vector3 position
        {
            get { Living(); return (object)above == null ? ownPosition : above.TransformPoint(ownPosition); }
            set { localPosition = (object)above == null ? value : above.InverseTransformPoint(value); }
        }

        public Quaternion rotation
        {
            get { Living(); return (object)above == null ? ownRotation : above.rotation * ownRotation; }
            set { localRotation = (object)above == null ? value : Quaternion.Inverse(above.rotation) * value; }
        }

        public Vector3 lossyScale
        {
            get
            {
                Matrix4x4 m = Matrix4x4.Rotate(Quaternion.Inverse(rotation)) * localToWorldMatrix;
                return new Vector3(m.m00, m.m11, m.m22);
            }
        }

        public Matrix4x4 localToWorldMatrix
        {
            get
            {
                Living();
                if (!isKept) // reading it is cheap in Unity, and frames are measured
                {
                    Matrix4x4 own = Matrix4x4.TRS(ownPosition, ownRotation, ownScale);
                    kept = (object)above == null ? own : above.localToWorldMatrix * own;
                    isKept = true;
                }
                return kept;
            }
        }

        public Matrix4x4 worldToLocalMatrix { get { return localToWorldMatrix.inverse; } }
        public Vector3 right { get { return rotation * Vector3.right; } }
        public Vector3 up { get { return rotation * Vector3.up; } }
        public Vector3 forward { get { return rotation * Vector3.forward; } }

        public Transform parent
        {
            get { Living(); return above; }
            set { SetParent(value, true); }
        }

        public int childCount { get { Living(); return children.Count; } }
        /// Not: paths.
        /// A name, or a path as "Child/Grandchild".
        public Transform Find(string n)
        {
            Living();
            string[] parts = n.Split(new[] { '/' }, 2);
            Transform found = children.Find(child => child.name == parts[0]);
            return found == null || parts.Length == 1 ? found : found.Find(parts[1]);
        }

        public Transform GetChild(int index)
        {
            if (index < 0 || index >= childCount)
            {
                throw new UnityException("Transform child out of bounds");
            }
            return children[index];
        }

        public IEnumerator GetEnumerator()
        {
            for (int i = 0; i < childCount; i++)
            {
                yield return GetChild(i);
            }
        }

        public void SetParent(Transform p) { SetParent(p, true); }

        public void SetParent(Transform p, bool worldPositionStays)
        {
            Living();
            bool was = gameObject.activeInHierarchy;
            Vector3 at = position;
            Quaternion turned = rotation;
            Vector3 scaled = lossyScale;
            if ((object)above != null)
            {
                above.children.Remove(this);
            }
            above = p == null ? null : p;
            if ((object)above != null)
            {
                above.children.Add(this);
            }
            if (worldPositionStays)
            {
                rotation = turned;
                position = at;
                Vector3 s = (object)above == null ? Vector3.one : above.lossyScale;
                ownScale = new Vector3(scaled.x / s.x, scaled.y / s.y, scaled.z / s.z);
            }
            Touch();
            if (gameObject.activeInHierarchy != was)
            {
                Player.ActivityChanged(gameObject);
            }
        }

        internal void Detach()
        {
            if ((object)above != null && !above.destroyed)
            {
                above.children.Remove(this);
            }
        }

        public Vector3 TransformPoint(Vector3 p) { return localToWorldMatrix.MultiplyPoint3x4(p); }
        public Vector3 InverseTransformPoint(Vector3 p) { return worldToLocalMatrix.MultiplyPoint3x4(p); }
    }
}
