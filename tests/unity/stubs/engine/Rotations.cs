// Test-only stand-ins, never shipped. Quaternions and matrices: Unity's element names, orders and sign conventions
// (left-handed, Euler angles about z, then x, then y; columns of a matrix are its axes).
using System;

namespace UnityEngine
{
    [Serializable]
    public struct Quaternion : IEquatable<Quaternion>
    {
        public float x, y, z, w;

        public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }

        public static Quaternion identity { get { return new Quaternion(0f, 0f, 0f, 1f); } }
        public Quaternion normalized
        {
            get
            {
                float length = (float)Math.Sqrt(Dot(this, this));
                return length < Mathf.Epsilon ? identity : new Quaternion(x / length, y / length, z / length, w / length);
            }
        }

        public static float Dot(Quaternion a, Quaternion b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }
        public static Quaternion Inverse(Quaternion q) { return new Quaternion(-q.x, -q.y, -q.z, q.w); }

        public static Quaternion AngleAxis(float angle, Vector3 axis)
        {
            double half = angle * Math.PI / 360.0;
            double length = Math.Sqrt((double)axis.x * axis.x + (double)axis.y * axis.y + (double)axis.z * axis.z);
            if (length < 1e-6)
            {
                return identity;
            }
            double s = Math.Sin(half) / length;
            return new Quaternion((float)(axis.x * s), (float)(axis.y * s), (float)(axis.z * s), (float)Math.Cos(half));
        }

        public static Quaternion Euler(float x, float y, float z)
        {
            return AngleAxis(y, Vector3.up) * AngleAxis(x, Vector3.right) * AngleAxis(z, Vector3.forward);
        }

        public static Quaternion Euler(Vector3 angles) { return Euler(angles.x, angles.y, angles.z); }

        public static Quaternion FromToRotation(Vector3 from, Vector3 to)
        {
            Vector3 a = from.normalized, b = to.normalized, c = Vector3.Cross(a, b);
            float dot = Vector3.Dot(a, b);
            if (dot < -0.999999f)
            {
                Vector3 any = Math.Abs(a.x) < 0.9f ? Vector3.right : Vector3.up;
                return AngleAxis(180f, Vector3.Cross(a, any));
            }
            return new Quaternion(c.x, c.y, c.z, 1f + dot).normalized;
        }

        public static Quaternion LookRotation(Vector3 forward, Vector3 up)
        {
            Vector3 f = forward.normalized;
            Vector3 r = Vector3.Cross(up, f).normalized;
            Vector3 u = Vector3.Cross(f, r);
            Matrix4x4 m = Matrix4x4.identity;
            m.SetColumn(0, r);
            m.SetColumn(1, u);
            m.SetColumn(2, f);
            return m.rotation;
        }

        public static Quaternion operator *(Quaternion a, Quaternion b)
        {
            return new Quaternion(a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                                  a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
                                  a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
                                  a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
        }

        public static Vector3 operator *(Quaternion q, Vector3 v)
        {
            Vector3 u = new Vector3(q.x, q.y, q.z);
            Vector3 t = 2f * Vector3.Cross(u, v);
            return v + q.w * t + Vector3.Cross(u, t);
        }

        public bool Equals(Quaternion o) { return x.Equals(o.x) && y.Equals(o.y) && z.Equals(o.z) && w.Equals(o.w); }
        public override bool Equals(object other) { return other is Quaternion && Equals((Quaternion)other); }
        public override int GetHashCode() { return x.GetHashCode() ^ (y.GetHashCode() << 2) ^ w.GetHashCode(); }
        public override string ToString() { return Text.Of("F5", x, y, z, w); }
    }

    /// m01 is row 0, column 1; in memory column by column.
    [Serializable]
    public struct Matrix4x4 : IEquatable<Matrix4x4>
    {
        public float m00, m10, m20, m30;
        public float m01, m11, m21, m31;
        public float m02, m12, m22, m32;
        public float m03, m13, m23, m33;

        public static Matrix4x4 zero { get { return new Matrix4x4(); } }

        public static Matrix4x4 identity
        {
            get { Matrix4x4 m = new Matrix4x4(); m.m00 = m.m11 = m.m22 = m.m33 = 1f; return m; }
        }

        public unsafe float this[int index]
        {
            get { Check(index); fixed (float* m = &m00) { return m[index]; } }
            set { Check(index); fixed (float* m = &m00) { m[index] = value; } }
        }

        public float this[int row, int column]
        {
            get { return this[row + 4 * column]; }
            set { this[row + 4 * column] = value; }
        }

        static void Check(int index)
        {
            if (index < 0 || index > 15)
            {
                throw new IndexOutOfRangeException("Invalid matrix index!");
            }
        }

        public Vector4 GetColumn(int c) { return new Vector4(this[0, c], this[1, c], this[2, c], this[3, c]); }
        public Vector4 GetRow(int r) { return new Vector4(this[r, 0], this[r, 1], this[r, 2], this[r, 3]); }
        public void SetColumn(int c, Vector4 v) { for (int i = 0; i < 4; i++) this[i, c] = v[i]; }

        public static Matrix4x4 Rotate(Quaternion q)
        {
            Matrix4x4 m = identity;
            m.SetColumn(0, q * Vector3.right);
            m.SetColumn(1, q * Vector3.up);
            m.SetColumn(2, q * Vector3.forward);
            return m;
        }

        public static Matrix4x4 TRS(Vector3 position, Quaternion rotation, Vector3 scale)
        {
            Matrix4x4 m = identity;
            m.SetColumn(0, (rotation * Vector3.right) * scale.x);
            m.SetColumn(1, (rotation * Vector3.up) * scale.y);
            m.SetColumn(2, (rotation * Vector3.forward) * scale.z);
            m.SetColumn(3, new Vector4(position.x, position.y, position.z, 1f));
            return m;
        }

        public Matrix4x4 transpose
        {
            get { Matrix4x4 m = new Matrix4x4(); for (int i = 0; i < 4; i++) m.SetColumn(i, GetRow(i)); return m; }
        }

        /// Only of affine matrices, as determinant.
        public Matrix4x4 inverse
        {
            get
            {
                Matrix4x4 m = identity;
                double d = Determinant3();
                if (d == 0.0)
                {
                    return zero;
                }
                for (int r = 0; r < 3; r++)
                {
                    for (int c = 0; c < 3; c++)
                    {
                        int a = (c + 1) % 3, b = (c + 2) % 3, e = (r + 1) % 3, f = (r + 2) % 3;
                        m[r, c] = (float)(((double)this[a, e] * this[b, f] - (double)this[a, f] * this[b, e]) / d);
                    }
                }
                m.SetColumn(3, -m.MultiplyVector(GetColumn(3)));
                m.m33 = 1f;
                return m;
            }
        }

        public float determinant { get { return (float)Determinant3(); } }

        double Determinant3()
        {
            return (double)m00 * ((double)m11 * m22 - (double)m12 * m21) -
                   (double)m01 * ((double)m10 * m22 - (double)m12 * m20) +
                   (double)m02 * ((double)m10 * m21 - (double)m11 * m20);
        }

        public Vector3 lossyScale
        {
            get
            {
                float sign = determinant < 0f ? -1f : 1f;
                return new Vector3(((Vector3)GetColumn(0)).magnitude * sign, ((Vector3)GetColumn(1)).magnitude,
                                   ((Vector3)GetColumn(2)).magnitude);
            }
        }

        /// Of matrices without shear, as Unity's. By the largest part, so that nothing small is divided by.
        public Quaternion rotation
        {
            get
            {
                Vector3 s = lossyScale;
                Vector3 a = (Vector3)GetColumn(0) / s.x, b = (Vector3)GetColumn(1) / s.y,
                    c = (Vector3)GetColumn(2) / s.z;
                float xx = 1f + a.x - b.y - c.z, yy = 1f - a.x + b.y - c.z, zz = 1f - a.x - b.y + c.z;
                float ww = 1f + a.x + b.y + c.z;
                Quaternion q;
                if (ww >= xx && ww >= yy && ww >= zz)
                {
                    q = new Quaternion(b.z - c.y, c.x - a.z, a.y - b.x, ww);
                }
                else if (xx >= yy && xx >= zz)
                {
                    q = new Quaternion(xx, a.y + b.x, a.z + c.x, b.z - c.y);
                }
                else if (yy >= zz)
                {
                    q = new Quaternion(a.y + b.x, yy, b.z + c.y, c.x - a.z);
                }
                else
                {
                    q = new Quaternion(a.z + c.x, b.z + c.y, zz, a.y - b.x);
                }
                return q.normalized;
            }
        }

        public Vector3 MultiplyPoint3x4(Vector3 p)
        {
            return new Vector3(m00 * p.x + m01 * p.y + m02 * p.z + m03, m10 * p.x + m11 * p.y + m12 * p.z + m13,
                               m20 * p.x + m21 * p.y + m22 * p.z + m23);
        }

        public Vector3 MultiplyVector(Vector3 v)
        {
            return new Vector3(m00 * v.x + m01 * v.y + m02 * v.z, m10 * v.x + m11 * v.y + m12 * v.z,
                               m20 * v.x + m21 * v.y + m22 * v.z);
        }

        public static Matrix4x4 operator *(Matrix4x4 a, Matrix4x4 b)
        {
            Matrix4x4 m = new Matrix4x4();
            for (int r = 0; r < 4; r++)
            {
                for (int c = 0; c < 4; c++)
                {
                    m[r, c] = a[r, 0] * b[0, c] + a[r, 1] * b[1, c] + a[r, 2] * b[2, c] + a[r, 3] * b[3, c];
                }
            }
            return m;
        }

        public static bool operator ==(Matrix4x4 a, Matrix4x4 b)
        {
            return a.GetColumn(0) == b.GetColumn(0) && a.GetColumn(1) == b.GetColumn(1) &&
                   a.GetColumn(2) == b.GetColumn(2) && a.GetColumn(3) == b.GetColumn(3);
        }

        public static bool operator !=(Matrix4x4 a, Matrix4x4 b) { return !(a == b); }

        public bool Equals(Matrix4x4 o)
        {
            return GetColumn(0).Equals(o.GetColumn(0)) && GetColumn(1).Equals(o.GetColumn(1)) &&
                   GetColumn(2).Equals(o.GetColumn(2)) && GetColumn(3).Equals(o.GetColumn(3));
        }

        public override bool Equals(object other) { return other is Matrix4x4 && Equals((Matrix4x4)other); }
        public override int GetHashCode() { return m00.GetHashCode() ^ m11.GetHashCode() ^ m22.GetHashCode(); }
    }
}
