// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using NUnit.Framework;

namespace Knurl.Tests
{
    /// <summary>C# and C agree on every byte.</summary>
    [TestFixture]
    public unsafe class MarshallingTests : Suite
    {
        const BindingFlags Statics = BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;
        const BindingFlags Fields = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic;

        static readonly Assembly Package = typeof(KnurlDevice).Assembly;

        static IEnumerable<knurl_unity_layout_row> Rows()
        {
            var all = new List<knurl_unity_layout_row>();
            knurl_unity_layout_row row;
            for (uint i = 0; NativeMethods.knurl_unity_layout(i, &row) != 0; i++)
            {
                all.Add(row);
            }
            return all;
        }

        /// <summary>The step of a pointer, as in C; Marshal.SizeOf may differ.</summary>
        static int SizeOf(Type type)
        {
            MethodInfo method = typeof(MarshallingTests).GetMethod("Step",
                BindingFlags.Static | BindingFlags.NonPublic);
            return (int)method.MakeGenericMethod(type).Invoke(null, null);
        }

        // The distance between neighbours in an array.
        static int Step<T>() where T : struct
        {
            var two = new T[2];
            GCHandle pin = GCHandle.Alloc(two, GCHandleType.Pinned);
            try
            {
                return (int)(Marshal.UnsafeAddrOfPinnedArrayElement(two, 1).ToInt64() -
                             Marshal.UnsafeAddrOfPinnedArrayElement(two, 0).ToInt64());
            }
            finally
            {
                pin.Free();
            }
        }

        static int SizeOf(FieldInfo field)
        {
            object[] buffers = field.GetCustomAttributes(typeof(FixedBufferAttribute), false);
            if (buffers.Length > 0)
            {
                var buffer = (FixedBufferAttribute)buffers[0];
                return buffer.Length * Marshal.SizeOf(buffer.ElementType);
            }
            return field.FieldType.IsPointer ? IntPtr.Size : SizeOf(field.FieldType);
        }

        [Test]
        public void EveryStructHasTheSizeThatTheLibraryGivesIt()
        {
            int structs = 0;
            foreach (knurl_unity_layout_row row in Rows())
            {
                if (row.field[0] == 0)
                {
                    string name = Utf8.Read(row.type);
                    Type type = Package.GetType("Knurl." + name);
                    Assert.That(type, Is.Not.Null, name);
                    Assert.AreEqual((int)row.size, SizeOf(type), name);
                    Assert.AreEqual((int)row.size, Marshal.SizeOf(type), name);
                    Assert.AreEqual((int)row.size, NativeMethods.SizeOf(name), name);
                    structs++;
                }
            }
            Assert.That(structs, Is.GreaterThan(30));
        }

        [Test]
        public void EveryFieldLiesWhereTheLibraryHasIt()
        {
            int fields = 0;
            foreach (knurl_unity_layout_row row in Rows())
            {
                if (row.field[0] != 0)
                {
                    Type type = Package.GetType("Knurl." + Utf8.Read(row.type));
                    string name = Utf8.Read(row.field);
                    FieldInfo field = type.GetField(name, Fields);
                    Assert.That(field, Is.Not.Null, type.Name + "." + name);
                    Assert.AreEqual((int)row.offset, (int)Marshal.OffsetOf(type, name), type.Name + "." + name);
                    Assert.AreEqual((int)row.size, SizeOf(field), type.Name + "." + name);
                    fields++;
                }
            }
            Assert.That(fields, Is.GreaterThan(200));
        }

        [Test]
        public void NoStructOfTheMirrorIsUnknownToTheLibrary()
        {
            var known = new Dictionary<string, int>();
            foreach (knurl_unity_layout_row row in Rows())
            {
                string name = Utf8.Read(row.type);
                known[name] = (known.ContainsKey(name) ? known[name] : 0) + (row.field[0] == 0 ? 0 : 1);
            }
            foreach (Type type in Package.GetTypes())
            {
                int fields = type.GetFields(Fields).Length;
                if (type.IsValueType && !type.IsEnum && type.Name.StartsWith("knurl_", StringComparison.Ordinal) &&
                    fields > 0)
                {
                    Assert.That(known.ContainsKey(type.Name), type.Name);
                    Assert.AreEqual(fields, known[type.Name], "fields of " + type.Name);
                }
            }
        }

        [Test]
        public void EveryFunctionIsInTheLibrary()
        {
            int functions = 0;
            foreach (MethodInfo method in typeof(NativeMethods).GetMethods(Statics))
            {
                if ((method.Attributes & MethodAttributes.PinvokeImpl) != 0)
                {
                    Assert.DoesNotThrow(() => Marshal.Prelink(method), method.Name);
                    functions++;
                }
            }
            Assert.That(functions, Is.GreaterThan(90));
        }

        [DllImport(NativeMethods.Library, ExactSpelling = true)]
        static extern void knurl_function_that_is_not_there();

        [Test]
        public void AFunctionThatIsNotThereIsNoticed()
        {
            MethodInfo method = typeof(MarshallingTests).GetMethod("knurl_function_that_is_not_there",
                BindingFlags.Static | BindingFlags.NonPublic);
            Assert.Throws<EntryPointNotFoundException>(() => Marshal.Prelink(method));
        }

        [Test]
        public void InterfaceAndVersionAreTheLibrarys()
        {
            Assert.AreEqual(NativeMethods.Interface, Utf8.Read(NativeMethods.knurl_unity_interface()));
            Assert.AreEqual(NativeMethods.Version, Utf8.Read(NativeMethods.knurl_version_string()));
            Assert.AreEqual(16, NativeMethods.Interface.Length);
            Assert.That(Library.Check(), Is.Null);
        }

        [Test]
        public void ASessionsDefaultsAreThoseOfItsHeader()
        {
            knurl_session_desc desc;
            Fill(&desc, sizeof(knurl_session_desc));
            NativeMethods.knurl_session_desc_init(&desc, (uint)sizeof(knurl_session_desc));
            Assert.AreEqual((uint)sizeof(knurl_session_desc), desc.struct_size);
            Assert.AreEqual(1u, desc.reconnect);
            Assert.AreEqual(1u, desc.clamp);
            Assert.AreEqual(0u, desc.even);
            Assert.AreEqual("fake", Utf8.Read(desc.device));
            Assert.AreEqual("", Utf8.Read(desc.stroke));
            Assert.AreEqual(1000.0, desc.update_rate_hz);
            Assert.AreEqual(0.25, desc.heartbeat_s);
            Assert.AreEqual(1.0, desc.workspace.scale);
            for (int i = 0; i < 9; i++)
            {
                Assert.AreEqual(i % 4 == 0 ? 1.0 : 0.0, desc.workspace.rotation[i]);
            }
        }

        [Test]
        public void TheOtherDefaultsAreThoseOfTheirHeaders()
        {
            knurl_plane_desc plane;
            Fill(&plane, sizeof(knurl_plane_desc));
            NativeMethods.knurl_plane_desc_init(&plane, (uint)sizeof(knurl_plane_desc));
            Assert.AreEqual(0.05, plane.half_extents[0]);
            Assert.AreEqual(0.05, plane.half_extents[1]);
            knurl_mesh_desc mesh;
            Fill(&mesh, sizeof(knurl_mesh_desc));
            NativeMethods.knurl_mesh_desc_init(&mesh, (uint)sizeof(knurl_mesh_desc));
            Assert.AreEqual((uint)sizeof(knurl_mesh_desc), mesh.struct_size);
            Assert.That(mesh.tangents == null && mesh.uvs == null && mesh.indices == null && mesh.index_count == 0);
            knurl_stroke_desc stroke;
            Fill(&stroke, sizeof(knurl_stroke_desc));
            NativeMethods.knurl_stroke_desc_init(&stroke, (uint)sizeof(knurl_stroke_desc));
            Assert.AreEqual(0.001, stroke.depth);
            Assert.AreEqual(0.0, stroke.speed);
            Assert.AreEqual(5.0, stroke.period);
            knurl_surface_desc surface;
            Fill(&surface, sizeof(knurl_surface_desc));
            NativeMethods.knurl_surface_desc_init(&surface, (uint)sizeof(knurl_surface_desc));
            Assert.AreEqual(0u, surface.double_sided);
            Assert.AreEqual(1.0, surface.rotation[3]);
            Assert.AreEqual(0.0, surface.axis[0]);
            knurl_scene_desc scene;
            Fill(&scene, sizeof(knurl_scene_desc));
            NativeMethods.knurl_scene_desc_init(&scene, (uint)sizeof(knurl_scene_desc));
            Assert.AreEqual(4096u, scene.max_surfaces);
            Assert.AreEqual(1u, scene.hip_count);
            knurl_hip_desc hip;
            Fill(&hip, sizeof(knurl_hip_desc));
            NativeMethods.knurl_hip_desc_init(&hip, (uint)sizeof(knurl_hip_desc));
            Assert.That(hip.resolution, Is.LessThan(0.0));
            Assert.That(hip.viscous, Is.LessThan(0.0));
            Assert.AreEqual(0u, hip.clamp);
            Assert.That(hip.workspace == null);
            knurl_loop_desc loop;
            Fill(&loop, sizeof(knurl_loop_desc));
            NativeMethods.knurl_loop_desc_init(&loop, (uint)sizeof(knurl_loop_desc));
            Assert.AreEqual(1000.0, loop.update_rate_hz);
            Assert.AreEqual(0.02, loop.ramp_s);
            Assert.AreEqual(0.05, loop.watchdog_s);
            Assert.AreEqual(0.0, loop.heartbeat_s);
            Assert.AreEqual(0u, loop.reconnect);
        }

        [Test]
        public void EveryInitWritesTheSizeThatItIsGiven()
        {
            const int room = 1 << 16;
            IntPtr memory = Marshal.AllocHGlobal(room);
            int functions = 0;
            foreach (MethodInfo method in typeof(NativeMethods).GetMethods(Statics))
            {
                ParameterInfo[] parameters = method.GetParameters();
                if (method.Name.EndsWith("_init", StringComparison.Ordinal) && parameters.Length == 2 &&
                    parameters[0].ParameterType.IsPointer && parameters[1].ParameterType == typeof(uint))
                {
                    int size = SizeOf(parameters[0].ParameterType.GetElementType());
                    Fill((void*)memory, room);
                    method.Invoke(null, new object[] { memory, (uint)size });
                    Assert.AreEqual(size, *(int*)memory, method.Name);
                    Assert.AreEqual(0x5a5a5a5a, *(int*)(memory + size), method.Name + " writes beyond the struct");
                    functions++;
                }
            }
            Marshal.FreeHGlobal(memory);
            Assert.That(functions, Is.GreaterThanOrEqualTo(15));
        }

        // So that defaults must be written, not just left over.
        static void Fill(void* what, int size)
        {
            for (int i = 0; i < size; i++)
            {
                ((byte*)what)[i] = 0x5a;
            }
        }

        [TestCase("")]
        [TestCase("plain")]
        [TestCase("Größe 日本 \U0001F590")]
        public void TextGoesToCAndComesBack(string text)
        {
            knurl_scene* scene = null;
            Assert.AreEqual(0, NativeMethods.knurl_scene_create(null, &scene));
            try
            {
                knurl_plane_desc plane;
                knurl_material_desc material;
                knurl_surface_desc desc;
                NativeMethods.knurl_plane_desc_init(&plane, (uint)sizeof(knurl_plane_desc));
                NativeMethods.knurl_material_desc_init(&material, (uint)sizeof(knurl_material_desc));
                NativeMethods.knurl_surface_desc_init(&desc, (uint)sizeof(knurl_surface_desc));
                material.stiffness = 400.0;
                material.spatial_frequency[0] = 1000.0;
                material.amplitude = 0.0002;
                desc.plane = &plane;
                desc.material = &material;
                ulong surface = 0;
                fixed (byte* name = Utf8.Bytes(text, "name"))
                {
                    desc.name = name;
                    KnurlException.Check(NativeMethods.knurl_scene_add_surface(scene, &desc, &surface));
                }
                byte* found = stackalloc byte[NativeMethods.KNURL_NAME_SIZE];
                KnurlException.Check(NativeMethods.knurl_scene_get_surface_name(scene, surface, found));
                Assert.AreEqual(text, Utf8.Read(found));
            }
            finally
            {
                NativeMethods.knurl_scene_destroy(scene);
            }
        }

        [Test]
        public void NoTextIsEmptyTextInBothDirections()
        {
            Assert.AreEqual("", Utf8.Read(null));
            Assert.AreEqual(new byte[] { 0 }, Utf8.Bytes(null, "nothing"));
        }

        [Test]
        public void TextWithAZeroInItIsRefused()
        {
            KnurlException e = Assert.Throws<KnurlException>(() => Utf8.Bytes("a\0b", "path"));
            Contains(e.Message, "path");
        }

        [Test]
        public void AnErrorsSentenceComesWithItsCode()
        {
            int stroke;
            fixed (byte* name = Utf8.Bytes("wïggle", "stroke"))
            {
                int result = NativeMethods.knurl_stroke_from_name(name, &stroke);
                KnurlException e = Assert.Throws<KnurlException>(() => KnurlException.Check(result));
                Assert.AreEqual(result, e.Code);
                Contains(e.Message, "wïggle");
            }
        }

        sealed class Heard
        {
            internal int Ticks;
            internal ulong Last;
            internal long User;
            internal double Height;
        }

        static Heard heard;

        [AOT.MonoPInvokeCallback(typeof(knurl_tick_callback))]
        static void Hear(knurl_tick_output* output, IntPtr user)
        {
            heard.Ticks++;
            heard.Last = output->tick;
            heard.User = user.ToInt64();
            heard.Height = output->hip[1];
        }

        [AOT.MonoPInvokeCallback(typeof(knurl_force_callback))]
        static void Pull(ulong tick, knurl_device_sample* sample, double* force, IntPtr user)
        {
            force[0] = force[1] = force[2] = 0.0;
        }

        [Test]
        public void CCallsCSharpInTicks()
        {
            heard = new Heard();
            knurl_scene* scene = null;
            knurl_device* device = null;
            knurl_loop* loop = null;
            knurl_tick_callback tick = Hear;
            fixed (byte* uri = Utf8.Bytes("fake", "uri"))
            {
                Assert.AreEqual(0, NativeMethods.knurl_device_open(uri, &device));
            }
            try
            {
                double* rows = stackalloc double[8];
                rows[2] = rows[6] = 0.0123;
                rows[4] = 1.0;
                Assert.AreEqual(0, NativeMethods.knurl_fake_set_trace(device, rows, 2));
                Assert.AreEqual(0, NativeMethods.knurl_scene_create(null, &scene));
                Assert.AreEqual(0, NativeMethods.knurl_scene_commit(scene));
                knurl_hip_desc hip;
                NativeMethods.knurl_hip_desc_init(&hip, (uint)sizeof(knurl_hip_desc));
                Assert.AreEqual(0, NativeMethods.knurl_scene_configure_hip(scene, 0, &hip));
                knurl_loop_desc desc;
                NativeMethods.knurl_loop_desc_init(&desc, (uint)sizeof(knurl_loop_desc));
                desc.device = device;
                desc.scene = scene;
                desc.tick_callback = Marshal.GetFunctionPointerForDelegate(tick);
                desc.user = new IntPtr(0x123456789abc);
                Assert.AreEqual(0, NativeMethods.knurl_loop_create(&desc, &loop));
                Assert.AreEqual(0, NativeMethods.knurl_loop_step(loop, 25));
                Assert.AreEqual(25, heard.Ticks);
                Assert.AreEqual(24UL, heard.Last);
                Assert.AreEqual(0x123456789abc, heard.User);
                Assert.AreEqual(0.0123, heard.Height, 1e-12);
                GC.KeepAlive(tick);
            }
            finally
            {
                NativeMethods.knurl_loop_destroy(loop);
                NativeMethods.knurl_scene_destroy(scene);
                NativeMethods.knurl_device_close(device);
            }
        }

        static int LengthOf(string text)
        {
            return text.Length;
        }

        /// <summary>The runtime handles the signal of a null reference: it must become an exception, not end the
        /// process.</summary>
        [Test]
        public void NullReferencesDoNotZeroForces()
        {
            knurl_device* device = null;
            Assert.AreEqual(0, NativeMethods.knurl_device_zero_on_exit(1));
            fixed (byte* uri = Utf8.Bytes("fake", "uri"))
            {
                Assert.AreEqual(0, NativeMethods.knurl_device_open(uri, &device));
            }
            try
            {
                double* force = stackalloc double[3];
                knurl_device_sample sample;
                knurl_fake_truth truth;
                force[1] = 1.0;
                Assert.AreEqual(0, NativeMethods.knurl_device_start(device, 1000.0));
                for (int i = 0; i < 3; i++)
                {
                    Assert.Throws<NullReferenceException>(() => LengthOf(null));
                    Assert.AreEqual(0, NativeMethods.knurl_device_read(device, &sample));
                    Assert.AreEqual(0, NativeMethods.knurl_device_write(device, force));
                }
                Assert.AreEqual(0, NativeMethods.knurl_device_read(device, &sample));
                Assert.AreEqual(0, NativeMethods.knurl_fake_get_truth(device, &truth));
                Assert.AreEqual(1.0, truth.motor[1], 1e-12);
            }
            finally
            {
                NativeMethods.knurl_device_close(device);
            }
        }
    }
}
