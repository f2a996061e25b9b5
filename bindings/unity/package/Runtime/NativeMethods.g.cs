// Generated from Knurl's headers by bindings/unity/native/mirror.py, which makes it anew; do not edit.
// Names are C's, so that they can be searched for; the headers document them.
#pragma warning disable 0649 // fields that only C fills in
using System;
using System.Runtime.InteropServices;

namespace Knurl
{
    internal struct knurl_scene { }

    internal struct knurl_audio { }

    internal struct knurl_device { }

    internal struct knurl_loop { }

    internal struct knurl_session { }

    internal struct knurl_sound { }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_allocator
    {
        public IntPtr allocate;
        public IntPtr release;
        public IntPtr user;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_velocity
    {
        public ulong alignment;
        public fixed byte state[11256];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_workspace
    {
        public fixed double origin[3];
        public fixed double rotation[9];
        public double scale;
        public fixed double reserved[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_plane_desc
    {
        public uint struct_size;
        public uint reserved;
        public fixed double half_extents[2];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_mesh_desc
    {
        public uint struct_size;
        public uint vertex_count;
        public float* positions;
        public float* tangents;
        public float* uvs;
        public uint* indices;
        public ulong index_count;
        public float* normals;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_vibration_event
    {
        public double positive;
        public double negative;
        public int length;
        public int positive_ticks;
        public int kind;
        public uint above_nyquist;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_wave
    {
        public double period_ticks;
        public double amplitude;
        public knurl_vibration_event parts_0;
        public knurl_vibration_event parts_1;
        public int method;
        public int part_count;
        public uint above_nyquist;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_grating
    {
        public int method;
        public fixed uint reserved[3];
        public fixed double spatial_frequency[2];
        public double amplitude;
        public double update_rate_hz;
        public double resolution;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_grating_state
    {
        public knurl_vibration_event @event;
        public long event_count;
        public int next_tick;
        public int playing;
        public int moving;
        public int sign;
        public fixed double tracked[2];
        public double phase;
        public double offset;
        public int axis;
        public int direction;
        public fixed ulong reserved[2];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_grating_output
    {
        public double height;
        public double spatial_frequency;
        public double temporal_frequency;
        public long @event;
        public uint above_nyquist;
        public uint turned;
        public ulong reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_method_input
    {
        public fixed double cycles[2];
        public fixed double velocity[2];
        public fixed double spatial_frequency[2];
        public double temporal_frequency;
        public double period;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_material_desc
    {
        public uint struct_size;
        public int method;
        public fixed double spatial_frequency[2];
        public double amplitude;
        public double stiffness;
        public double damping;
        public double friction;
        public double orientation;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_surface_desc
    {
        public uint struct_size;
        public uint double_sided;
        public byte* name;
        public knurl_plane_desc* plane;
        public knurl_mesh_desc* mesh;
        public knurl_material_desc* material;
        public fixed double position[3];
        public fixed double rotation[4];
        public fixed double normal[3];
        public fixed double axis[3];
        public ulong shape_of;
        public int coordinates;
        public int smooth;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_scene_desc
    {
        public uint struct_size;
        public uint max_surfaces;
        public uint hip_count;
        public uint full_model;
        public knurl_allocator* allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_hip_desc
    {
        public uint struct_size;
        public uint protections;
        public uint clamp;
        public uint reserved;
        public knurl_workspace* workspace;
        public double update_rate_hz;
        public double resolution;
        public double max_force;
        public double continuous_force;
        public double heat_time;
        public double viscous;
        public double delay;
        public double max_stiffness;
        public double slew_rate;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_gain
    {
        public double hz;
        public double gain;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_tick_input
    {
        public fixed double position[3];
        public fixed double velocity[3];
        public uint has_velocity;
        public uint absent;
        public double attenuation;
        public uint paused;
        public fixed uint reserved[9];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_tick_output
    {
        public fixed double device_force[3];
        public fixed double force[3];
        public fixed double hip[3];
        public fixed double hip_velocity[3];
        public fixed double proxy[3];
        public fixed double normal[3];
        public fixed double surface_velocity[2];
        public double depth;
        public double height;
        public double spatial_frequency;
        public double temporal_frequency;
        public long @event;
        public ulong surface;
        public ulong tick;
        public uint flags;
        public uint contacts;
        public fixed double cycles[2];
        public fixed ulong reserved[6];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_hip_counts
    {
        public ulong ticks;
        public ulong contact_ticks;
        public ulong events;
        public ulong force_limit_ticks;
        public ulong above_nyquist_ticks;
        public ulong non_finite_ticks;
        public ulong entry_ticks;
        public ulong slew_ticks;
        public ulong heat_ticks;
        public ulong passivity_ticks;
        public double force_max;
        public double heat;
        public double half_cycles_crossed;
        public ulong half_cycles_played;
        public ulong squeezed_ticks;
        public ulong visit_limit_ticks;
        public fixed ulong reserved[4];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_hip_contact
    {
        public ulong surface;
        public fixed double proxy[3];
        public fixed double normal[3];
        public double depth;
        public fixed ulong reserved[6];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_audio_desc
    {
        public uint struct_size;
        public uint is_offline;
        public double update_rate_hz;
        public double sample_rate_hz;
        public double latency_s;
        public int voice;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_device_info
    {
        public uint struct_size;
        public uint reserved;
        public fixed byte name[64];
        public fixed double workspace_min[3];
        public fixed double workspace_max[3];
        public double resolution;
        public double max_force;
        public double delay;
        public double continuous_force;
        public double heat_time;
        public double mass;
        public double viscous;
        public double coulomb;
        public double max_stiffness;
        public double native_rate;
        public double max_torque;
        public double max_grip;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_device_sample
    {
        public fixed double position[3];
        public fixed double orientation[4];
        public double grip;
        public fixed double joints[8];
        public uint buttons;
        public uint joint_count;
        public fixed uint reserved[8];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_device_torque
    {
        public fixed double torque[3];
        public double grip;
        public fixed double reserved[4];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_device_listing
    {
        public fixed byte uri[256];
        public fixed byte name[128];
        public fixed byte reason[1024];
        public fixed ulong reserved[4];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_device_event
    {
        public long time_ns;
        public double value;
        public int code;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_device_status
    {
        public uint struct_size;
        public uint lost;
        public uint halted;
        public uint buttons;
        public ulong exchanges;
        public ulong bad_bytes;
        public ulong events;
        public double exchange_ns_p50;
        public double exchange_ns_p99;
        public fixed double orientation[4];
        public double grip;
        public double battery;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_device_functions
    {
        public uint struct_size;
        public uint blocking;
        public IntPtr user;
        public IntPtr get_info;
        public IntPtr start;
        public IntPtr read;
        public IntPtr write;
        public IntPtr reopen;
        public IntPtr close;
        public uint motors_known;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_effect
    {
        public int kind;
        public uint reserved_bits;
        public fixed double anchor[3];
        public fixed double axis[3];
        public double stiffness;
        public double damping;
        public double spacing;
        public double max_force;
        public fixed ulong reserved[4];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_stroke_desc
    {
        public uint struct_size;
        public int stroke;
        public fixed double centre[3];
        public fixed double x[3];
        public fixed double normal[3];
        public fixed double reach[2];
        public double depth;
        public double speed;
        public double period;
        public double* path;
        public uint path_rows;
        public uint path_loop;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_fake_truth
    {
        public fixed double position[3];
        public fixed double velocity[3];
        public fixed double motor[3];
        public fixed double hand[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_gltf_options
    {
        public uint struct_size;
        public uint max_surfaces;
        public ulong max_bytes;
        public ulong max_vertices;
        public ulong max_triangles;
        public double max_seconds;
        public IntPtr file_read;
        public IntPtr progress;
        public IntPtr user;
        public IntPtr wrong_tag;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_gltf_report
    {
        public uint struct_size;
        public uint surfaces;
        public uint skipped;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_gltf_texture
    {
        public uint struct_size;
        public uint texcoord;
        public byte* use;
        public byte* name;
        public IntPtr data;
        public ulong size;
        public byte* problem;
        public fixed double from_uv[4];
        public double scale;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_clock
    {
        public IntPtr now_ns;
        public IntPtr sleep_until_ns;
        public IntPtr user;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_loop_desc
    {
        public uint struct_size;
        public uint hip;
        public knurl_device* device;
        public knurl_scene* scene;
        public IntPtr force_callback;
        public IntPtr tick_callback;
        public IntPtr user;
        public double update_rate_hz;
        public ulong tick_limit;
        public double ramp_s;
        public double watchdog_s;
        public knurl_clock* clock;
        public uint protections;
        public uint reconnect;
        public double heartbeat_s;
        public IntPtr torque_callback;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_percentiles
    {
        public double p50;
        public double p99;
        public double max;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_loop_stats
    {
        public uint struct_size;
        public int state;
        public ulong ticks;
        public ulong overruns;
        public ulong watchdog_trips;
        public uint realtime;
        public uint memory_locked;
        public knurl_percentiles tick_ns;
        public knurl_percentiles jitter_ns;
        public ulong heat_ticks;
        public double heat;
        public ulong absences;
        public uint absent;
        public uint paused;
        public uint io_realtime;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_surface_info
    {
        public uint struct_size;
        public uint triangle_count;
        public uint dropped_triangles;
        public uint double_sided;
        public fixed byte name[256];
        public byte* shape;
        public byte* model;
        public ulong bytes;
        public fixed double bounds_min[3];
        public fixed double bounds_max[3];
        public fixed double anchor[3];
        public fixed double anchor_x[3];
        public fixed double anchor_normal[3];
        public fixed double anchor_reach[4];
        public fixed double stretch[3];
        public byte* why;
        public double model_error;
        public uint reversed_twins;
        public uint turned_triangles;
        public fixed double axis[3];
        public fixed double stretch_y[3];
        public double seam;
        public ulong touching_pairs;
        public uint curved_triangles;
        public uint bad_normals;
        public double bulge;
        public byte* coordinates;
        public double uneven;
        public uint projection_seams;
        public int smooth;
        public uint edges;
        public uint hard_edges;
        public fixed double facet_angle[2];
        public fixed double felt_angle[2];
        public fixed double uv_scale[2];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_surface_point
    {
        public uint struct_size;
        public uint hint;
        public ulong surface;
        public double distance;
        public fixed double position[3];
        public fixed double normal[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_surface_check
    {
        public uint struct_size;
        public uint exceeded;
        public double stiffness;
        public double stiffness_limit;
        public double amplitude;
        public double amplitude_limit;
        public fixed byte message[1024];
        public double lowest_gain;
        public fixed double lowered_hz[2];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_stroke_report
    {
        public uint struct_size;
        public uint is_outside;
        public uint follows;
        public uint reserved;
        public double length;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_session_desc
    {
        public uint struct_size;
        public uint reconnect;
        public uint clamp;
        public uint even;
        public byte* device;
        public byte* stroke;
        public double update_rate_hz;
        public double heartbeat_s;
        public knurl_workspace workspace;
        public byte* response;
        public ulong response_size;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_session_state
    {
        public fixed double hip[3];
        public fixed double proxy[3];
        public fixed double force[3];
        public double height;
        public double temporal_frequency;
        public ulong surface;
        public ulong ticks;
        public ulong overruns;
        public uint buttons;
        public uint running;
        public uint in_contact;
        public uint paused;
        public fixed double velocity[3];
        public double depth;
        public fixed double impulse[3];
        public fixed double stylus[4];
        public double ridges;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_session_event
    {
        public int kind;
        public int code;
        public double value;
        public ulong surface;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_session_way
    {
        public fixed double position[3];
        public fixed double rotation[4];
        public fixed double times[2];
        public fixed double speeds[2];
        public fixed double changes[2];
        public double lag;
        public ulong tick;
        public uint clock;
        public uint is_guess;
        public uint moved;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_session_pose
    {
        public fixed double position[3];
        public fixed double rotation[9];
        public fixed double quaternion[4];
        public fixed double rest[9];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct knurl_unity_layout_row
    {
        public byte* type;
        public byte* field;
        public uint offset;
        public uint size;
    }

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate IntPtr knurl_allocator_allocate(UIntPtr size, UIntPtr alignment, IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_allocator_release(IntPtr memory, UIntPtr size, IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate double knurl_method_function(knurl_method_input* input, double* memory, IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_device_functions_get_info(IntPtr user, knurl_device_info* info);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate int knurl_device_functions_start(IntPtr user, double update_rate_hz);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate int knurl_device_functions_read(IntPtr user, knurl_device_sample* sample);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate int knurl_device_functions_write(IntPtr user, double* force);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate int knurl_device_functions_reopen(IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_device_functions_close(IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_gltf_options_file_read(IntPtr user, byte* path);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate int knurl_gltf_options_progress(IntPtr user, double done);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_gltf_options_wrong_tag(IntPtr user, byte* message);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_gltf_list_callback(IntPtr user, byte* array, uint index, byte* @object,
        byte* tag);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_gltf_write_callback(IntPtr user, IntPtr data, ulong size);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_gltf_texture_callback(IntPtr user, knurl_gltf_texture* texture);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_force_callback(ulong tick, knurl_device_sample* sample, double* force,
        IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_torque_callback(ulong tick, knurl_device_sample* sample,
        knurl_device_torque* torque, IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_tick_callback(knurl_tick_output* output, IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate long knurl_clock_now_ns(IntPtr user);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void knurl_clock_sleep_until_ns(long deadline_ns, IntPtr user);

    internal static unsafe class NativeMethods
    {
        internal const string Library = "knurl_unity";

        /// <summary>The result of knurl_unity_interface() of the library that this file was generated for.</summary>
        internal const string Interface = "7f906dbfcfd98fe4";

        internal const string Version = "0.3.0";

        /// <summary>The bytes of the struct of that name in C#; 0 if there is none.</summary>
        internal static int SizeOf(string type)
        {
            switch (type)
            {
                case "knurl_allocator": return sizeof(knurl_allocator);
                case "knurl_velocity": return sizeof(knurl_velocity);
                case "knurl_workspace": return sizeof(knurl_workspace);
                case "knurl_plane_desc": return sizeof(knurl_plane_desc);
                case "knurl_mesh_desc": return sizeof(knurl_mesh_desc);
                case "knurl_vibration_event": return sizeof(knurl_vibration_event);
                case "knurl_wave": return sizeof(knurl_wave);
                case "knurl_grating": return sizeof(knurl_grating);
                case "knurl_grating_state": return sizeof(knurl_grating_state);
                case "knurl_grating_output": return sizeof(knurl_grating_output);
                case "knurl_method_input": return sizeof(knurl_method_input);
                case "knurl_material_desc": return sizeof(knurl_material_desc);
                case "knurl_surface_desc": return sizeof(knurl_surface_desc);
                case "knurl_scene_desc": return sizeof(knurl_scene_desc);
                case "knurl_hip_desc": return sizeof(knurl_hip_desc);
                case "knurl_gain": return sizeof(knurl_gain);
                case "knurl_tick_input": return sizeof(knurl_tick_input);
                case "knurl_tick_output": return sizeof(knurl_tick_output);
                case "knurl_hip_counts": return sizeof(knurl_hip_counts);
                case "knurl_hip_contact": return sizeof(knurl_hip_contact);
                case "knurl_audio_desc": return sizeof(knurl_audio_desc);
                case "knurl_device_info": return sizeof(knurl_device_info);
                case "knurl_device_sample": return sizeof(knurl_device_sample);
                case "knurl_device_torque": return sizeof(knurl_device_torque);
                case "knurl_device_listing": return sizeof(knurl_device_listing);
                case "knurl_device_event": return sizeof(knurl_device_event);
                case "knurl_device_status": return sizeof(knurl_device_status);
                case "knurl_device_functions": return sizeof(knurl_device_functions);
                case "knurl_effect": return sizeof(knurl_effect);
                case "knurl_stroke_desc": return sizeof(knurl_stroke_desc);
                case "knurl_fake_truth": return sizeof(knurl_fake_truth);
                case "knurl_gltf_options": return sizeof(knurl_gltf_options);
                case "knurl_gltf_report": return sizeof(knurl_gltf_report);
                case "knurl_gltf_texture": return sizeof(knurl_gltf_texture);
                case "knurl_clock": return sizeof(knurl_clock);
                case "knurl_loop_desc": return sizeof(knurl_loop_desc);
                case "knurl_percentiles": return sizeof(knurl_percentiles);
                case "knurl_loop_stats": return sizeof(knurl_loop_stats);
                case "knurl_surface_info": return sizeof(knurl_surface_info);
                case "knurl_surface_point": return sizeof(knurl_surface_point);
                case "knurl_surface_check": return sizeof(knurl_surface_check);
                case "knurl_stroke_report": return sizeof(knurl_stroke_report);
                case "knurl_session_desc": return sizeof(knurl_session_desc);
                case "knurl_session_state": return sizeof(knurl_session_state);
                case "knurl_session_event": return sizeof(knurl_session_event);
                case "knurl_session_way": return sizeof(knurl_session_way);
                case "knurl_session_pose": return sizeof(knurl_session_pose);
                case "knurl_unity_layout_row": return sizeof(knurl_unity_layout_row);
                default: return 0;
            }
        }

        internal const int KNURL_VERSION_MAJOR = 0;
        internal const int KNURL_VERSION_MINOR = 3;
        internal const int KNURL_VERSION_PATCH = 0;
        internal const double KNURL_COORDINATE_MAX = 1000000000.0;
        internal const double KNURL_DEFAULT = -1.0;
        internal const double KNURL_TRACK_S = 0.02;
        internal const double KNURL_CREASE_ANGLE = 0.75;
        internal const int KNURL_NO_EVENT = -1;
        internal const double KNURL_S2_DEADBAND = 0.001;
        internal const int KNURL_CONTACTS_MAX = 4;
        internal const double KNURL_UPDATE_RATE_MIN = 100.0;
        internal const double KNURL_UPDATE_RATE_MAX = 10000.0;
        internal const int KNURL_VISITS_MAX = 800;
        internal const int KNURL_GAINS = 75;
        internal const int KNURL_EFFECTS_MAX = 8;
        internal const int KNURL_PATH_ROWS_MAX = 65536;
        internal const int KNURL_NAME_SIZE = 256;
        internal const double KNURL_FAR = 1000000.0;
        internal const double KNURL_STRETCH_MAX = 2.0;
        internal const int KNURL_SESSION_HISTORY = 8192;
        internal const int KNURL_OK = 0;
        internal const int KNURL_ERROR_ARGUMENT = -1;
        internal const int KNURL_ERROR_STATE = -2;
        internal const int KNURL_ERROR_MEMORY = -3;
        internal const int KNURL_ERROR_STALE_ID = -4;
        internal const int KNURL_ERROR_FULL = -5;
        internal const int KNURL_ERROR_UNSUPPORTED = -6;
        internal const int KNURL_ERROR_IO = -7;
        internal const int KNURL_ERROR_FORMAT = -8;
        internal const int KNURL_ERROR_UNKNOWN = -9;
        internal const int KNURL_ERROR_DEVICE_LOST = -10;
        internal const int KNURL_ERROR_SYSTEM = -11;
        internal const int KNURL_ERROR_DEVICE_NOT_READY = -12;
        internal const int KNURL_ERROR_CANCELLED = -13;
        internal const int KNURL_VELOCITY_AUTO = 0;
        internal const int KNURL_VELOCITY_DIFFERENCE = 1;
        internal const int KNURL_VELOCITY_FOAW = 2;
        internal const int KNURL_SMOOTH_AUTO = 0;
        internal const int KNURL_SMOOTH_OFF = 1;
        internal const int KNURL_SMOOTH_ON = 2;
        internal const int KNURL_WAVE_T1 = 17;
        internal const int KNURL_WAVE_T2 = 18;
        internal const int KNURL_WAVE_T3 = 19;
        internal const int KNURL_EVENT_EVEN = 0;
        internal const int KNURL_EVENT_ODD = 1;
        internal const int KNURL_EVENT_MIXED = 2;
        internal const int KNURL_METHOD_DEFAULT = 0;
        internal const int KNURL_METHOD_S1 = 1;
        internal const int KNURL_METHOD_S2 = 2;
        internal const int KNURL_METHOD_BANDLIMITED = 3;
        internal const int KNURL_COORDINATES_AUTO = 0;
        internal const int KNURL_COORDINATES_BOX = 1;
        internal const int KNURL_PROTECT_ENTRY = 1;
        internal const int KNURL_PROTECT_SLEW = 2;
        internal const int KNURL_PROTECT_HEAT = 4;
        internal const int KNURL_PROTECT_PASSIVITY = 8;
        internal const int KNURL_PROTECT_ALL = 15;
        internal const int KNURL_TICK_CONTACT = 1;
        internal const int KNURL_TICK_FORCE_LIMIT = 2;
        internal const int KNURL_TICK_ABOVE_NYQUIST = 4;
        internal const int KNURL_TICK_NOT_FINITE = 8;
        internal const int KNURL_TICK_CONTACTS_FULL = 16;
        internal const int KNURL_TICK_ENTRY = 32;
        internal const int KNURL_TICK_SLEW = 64;
        internal const int KNURL_TICK_HEAT = 128;
        internal const int KNURL_TICK_PASSIVITY = 256;
        internal const int KNURL_TICK_ABSENT = 512;
        internal const int KNURL_TICK_SQUEEZED = 1024;
        internal const int KNURL_TICK_VISIT_LIMIT = 2048;
        internal const int KNURL_VOICE_EAR = 0;
        internal const int KNURL_VOICE_COIL = 1;
        internal const int KNURL_FAULT_LOST = 1;
        internal const int KNURL_FAULT_SILENT = 2;
        internal const int KNURL_FAULT_CORRUPT = 3;
        internal const int KNURL_FAULT_NOT_FINITE = 4;
        internal const int KNURL_FAULT_JUMP = 5;
        internal const int KNURL_FAULT_LATE = 6;
        internal const int KNURL_FAULT_OVERRUN = 7;
        internal const int KNURL_FAULT_WATCHDOG = 8;
        internal const int KNURL_FAULT_HEARTBEAT = 9;
        internal const int KNURL_FAULT_REFUSED = 10;
        internal const int KNURL_FAULT_UNCALIBRATED = 11;
        internal const int KNURL_FAULT_UNGUARDED = 12;
        internal const int KNURL_FAULT_GAP = 13;
        internal const int KNURL_FAULT_BACKWARDS_X = 14;
        internal const int KNURL_FAULT_BACKWARDS_Y = 15;
        internal const int KNURL_FAULT_BACKWARDS_Z = 16;
        internal const int KNURL_FAULT_FORCE_OFF = 17;
        internal const int KNURL_FAULT_RESUMED = 32;
        internal const int KNURL_FAULT_RECONNECTED = 33;
        internal const int KNURL_FAULT_BATTERY = 34;
        internal const int KNURL_FORCE_OFF_UNTOLD = 0;
        internal const int KNURL_FORCE_OFF_BUTTON = 1;
        internal const int KNURL_FORCE_OFF_VELOCITY = 2;
        internal const int KNURL_FORCE_OFF_WATCHDOG = 3;
        internal const int KNURL_FORCE_OFF_SOFTWARE = 4;
        internal const int KNURL_FORCE_OFF_CABLE = 5;
        internal const int KNURL_FORCE_OFF_DEADMAN = 6;
        internal const int KNURL_FORCE_OFF_POWER = 7;
        internal const int KNURL_FORCE_OFF_NOT_READY = 8;
        internal const int KNURL_FORCE_OFF_BRAKE = 9;
        internal const int KNURL_EFFECT_SPRING = 1;
        internal const int KNURL_EFFECT_DETENT = 2;
        internal const int KNURL_EFFECT_DAMPER = 3;
        internal const int KNURL_EFFECT_LINE = 4;
        internal const int KNURL_EFFECT_PLANE = 5;
        internal const int KNURL_EFFECT_FORCE = 6;
        internal const int KNURL_STROKE_LINE = 1;
        internal const int KNURL_STROKE_SWEEP = 2;
        internal const int KNURL_STROKE_CIRCLE = 3;
        internal const int KNURL_STROKE_PRESS = 4;
        internal const int KNURL_STROKE_REST = 5;
        internal const int KNURL_LOOP_IDLE = 0;
        internal const int KNURL_LOOP_RUNNING = 1;
        internal const int KNURL_LOOP_DONE = 2;
        internal const int KNURL_LOOP_LOST = 3;
        internal const int KNURL_LIMIT_STABILITY = 1;
        internal const int KNURL_LIMIT_STIFFNESS = 2;
        internal const int KNURL_LIMIT_AMPLITUDE = 4;
        internal const int KNURL_LIMIT_HEAT = 8;
        internal const int KNURL_LIMIT_PERIOD = 16;
        internal const int KNURL_LIMIT_STRETCH = 32;
        internal const int KNURL_LIMIT_FAR = 64;
        internal const int KNURL_LIMIT_VISITS = 128;
        internal const int KNURL_LIMIT_WINDING = 256;
        internal const int KNURL_LIMIT_NORMALS = 512;
        internal const int KNURL_SESSION_CONTACT_STARTED = 1;
        internal const int KNURL_SESSION_CONTACT_ENDED = 2;
        internal const int KNURL_SESSION_BUTTON = 3;
        internal const int KNURL_SESSION_FAULT = 4;
        internal const int KNURL_SESSION_ENDED = 5;
        internal const int KNURL_SESSION_FRAMES = 0;
        internal const int KNURL_SESSION_STEPS = 1;
        internal const int KNURL_SESSION_CLOCKS = 2;

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_result_string(int result);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_error_message();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern UIntPtr knurl_text_line(byte* to, UIntPtr size, byte* from);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_version_string();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_version_number();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_velocity_prepare(int method, double resolution, double update_rate_hz,
            knurl_velocity* velocity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_velocity_update(knurl_velocity* velocity, double* position, double* @out);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_velocity_track(knurl_velocity* estimator, double* position, double* velocity,
            double* tracked);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_workspace_set_identity(knurl_workspace* workspace);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_workspace_check(knurl_workspace* workspace);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_workspace_to_scene(knurl_workspace* workspace, double* device, double* scene);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_workspace_to_device(knurl_workspace* workspace, double* scene,
            double* device);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_workspace_vector_to_device(knurl_workspace* workspace, double* scene,
            double* device);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_plane_desc_init(knurl_plane_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_mesh_desc_init(knurl_mesh_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_vibration_event_prepare(double period_ticks, double amplitude,
            knurl_vibration_event* @event);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern double knurl_vibration_event_height(knurl_vibration_event* @event, int index);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_wave_prepare(int method, double period_s, double amplitude,
            double update_rate_hz, knurl_wave* wave);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern double knurl_wave_value(knurl_wave* wave, ulong tick);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_grating_check(knurl_grating* grating);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern double knurl_grating_frequency(double* spatial_frequency, double* velocity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_grating_step(knurl_grating* grating, knurl_grating_state* state,
            double* position, double* velocity, knurl_grating_output* output);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_method_add(byte* name, double crest, IntPtr height, IntPtr user, int* method);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern ulong knurl_method_get_faults(int method);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_method_name(int method);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_method_from_name(byte* name, int* method);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_material_desc_init(knurl_material_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_surface_desc_init(knurl_surface_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_scene_desc_init(knurl_scene_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_create(knurl_scene_desc* desc, knurl_scene** scene);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_scene_destroy(knurl_scene* scene);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_add_surface(knurl_scene* scene, knurl_surface_desc* desc,
            ulong* surface);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_remove_surface(knurl_scene* scene, ulong surface);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_replace_surface(knurl_scene* scene, ulong surface,
            knurl_surface_desc* desc);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_scene_has_surface(knurl_scene* scene, ulong surface);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_set_material(knurl_scene* scene, ulong surface,
            knurl_material_desc* material);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_get_material(knurl_scene* scene, ulong surface,
            knurl_material_desc* material);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_set_transform(knurl_scene* scene, ulong surface, double* position,
            double* rotation, double seconds);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_commit(knurl_scene* scene);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_scene_collect(knurl_scene* scene);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern ulong knurl_scene_get_bytes(knurl_scene* scene);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_lock_memory(knurl_scene* scene);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_hip_desc_init(knurl_hip_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_configure_hip(knurl_scene* scene, uint hip, knurl_hip_desc* desc);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_set_gains(knurl_scene* scene, uint hip, knurl_gain* gains, uint count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_gains_from_response(byte* file, ulong size, knurl_gain* gains);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_gains_from_plant(double mass, double viscous, double update_rate_hz,
            knurl_gain* gains);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_get_workspace(knurl_scene* scene, uint hip, knurl_workspace* workspace);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_set_workspace(knurl_scene* scene, uint hip, knurl_workspace* workspace,
            double seconds);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_tick(knurl_scene* scene, uint hip, knurl_tick_input* input,
            knurl_tick_output* output);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_tick_batch(knurl_scene* scene, uint hip, knurl_tick_input* inputs,
            ulong count, knurl_tick_output* outputs);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_get_tick(knurl_scene* scene, uint hip, knurl_tick_output* output,
            knurl_hip_counts* counts);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_scene_get_contacts(knurl_scene* scene, uint hip, knurl_hip_contact* contacts,
            uint capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_audio_desc_init(knurl_audio_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_audio_create(knurl_audio_desc* desc, knurl_audio** audio);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_audio_destroy(knurl_audio* audio);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_audio_take(knurl_tick_output* output, IntPtr audio);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_audio_fill(knurl_audio* audio, float* samples, uint count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_audio_get_rumble(knurl_audio* audio, double* rumble);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_device_info_init(knurl_device_info* info, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_device_status_init(knurl_device_status* status, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_device_open(byte* uri, knurl_device** device);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_device_close(knurl_device* device);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_device_list(knurl_device_listing* listings, uint capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_device_get_info(knurl_device* device, knurl_device_info* info);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_device_get_status(knurl_device* device, knurl_device_status* status);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_device_next_event(knurl_device* device, knurl_device_event* @event);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_fault_name(int code);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_fault_string(int code);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_fault_unit(int code);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_fault_cause(int code, double value);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_device_start(knurl_device* device, double update_rate_hz);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_device_read(knurl_device* device, knurl_device_sample* sample);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_device_write(knurl_device* device, double* force);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_device_halt(knurl_device* device);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_device_zero_on_exit(uint faults_recover);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_device_functions_init(knurl_device_functions* functions, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_device_open_functions(knurl_device_functions* functions,
            knurl_device** device);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_effect_prepare(int kind, knurl_effect* effect);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_set_effects(knurl_scene* scene, uint hip, knurl_effect* effects,
            uint count, double seconds);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_stroke_desc_init(knurl_stroke_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_fake_keys();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_fake_set_stroke(knurl_device* device, knurl_stroke_desc* desc);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_fake_get_truth(knurl_device* device, knurl_fake_truth* truth);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_fake_set_trace(knurl_device* device, double* rows, ulong row_count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_stroke_from_name(byte* name, int* stroke);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_gltf_options_init(knurl_gltf_options* options, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_gltf_report_init(knurl_gltf_report* report, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_gltf_load_file(knurl_scene* scene, byte* path, knurl_gltf_options* options,
            knurl_gltf_report* report);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_gltf_load_memory(knurl_scene* scene, IntPtr data, ulong size, byte* name,
            byte* folder, knurl_gltf_options* options, knurl_gltf_report* report);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_gltf_list_tags(IntPtr data, ulong size, byte* name, IntPtr each, IntPtr user);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_gltf_set_tag(IntPtr data, ulong size, byte* name, byte* array, uint index,
            byte* tag, IntPtr write, IntPtr user);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_gltf_read_textures(IntPtr data, ulong size, byte* name, byte* folder,
            byte* array, uint index, IntPtr each, IntPtr user);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_loop_desc_init(knurl_loop_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_loop_stats_init(knurl_loop_stats* stats, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_loop_create(knurl_loop_desc* desc, knurl_loop** loop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_loop_destroy(knurl_loop* loop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_loop_start(knurl_loop* loop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_loop_step(knurl_loop* loop, ulong ticks);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_loop_request_stop(knurl_loop* loop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_loop_stop(knurl_loop* loop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_loop_pause(knurl_loop* loop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_loop_resume(knurl_loop* loop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_loop_set_gain(knurl_loop* loop, double gain);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_loop_set_force(knurl_loop* loop, double* force);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_loop_vibrate(knurl_loop* loop, int method, double frequency_hz,
            double amplitude, double* direction, double seconds);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_loop_heartbeat(knurl_loop* loop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_loop_wait(knurl_loop* loop, double seconds);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_loop_get_stats(knurl_loop* loop, knurl_loop_stats* stats);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_scene_get_surface_count(knurl_scene* scene);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern ulong knurl_scene_get_surface(knurl_scene* scene, uint index);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_find_surface(knurl_scene* scene, byte* name, ulong* surface);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_get_surface_name(knurl_scene* scene, ulong surface, byte* name);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_surface_info_init(knurl_surface_info* info, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_get_surface_info(knurl_scene* scene, ulong surface,
            knurl_surface_info* info);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_surface_point_init(knurl_surface_point* point, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_find_closest(knurl_scene* scene, double* position, double radius,
            knurl_surface_point* point);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_find_closest_batch(knurl_scene* scene, double* positions, ulong count,
            double radius, knurl_surface_point* points);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_cast_ray(knurl_scene* scene, double* from, double* to,
            knurl_surface_point* point);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_surface_check_init(knurl_surface_check* check, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_scene_check_surface(knurl_scene* scene, uint hip, ulong surface,
            knurl_surface_check* check);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_stroke_report_init(knurl_stroke_report* report, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_fake_lay_stroke(knurl_device* device, knurl_scene* scene, uint hip,
            ulong surface, int stroke, knurl_stroke_report* report);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_session_desc_init(knurl_session_desc* desc, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_create(IntPtr* session);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_session_destroy(IntPtr session);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_session_close_all();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern knurl_scene* knurl_session_get_scene(SessionHandle session);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern knurl_device* knurl_session_get_device(SessionHandle session);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern knurl_loop* knurl_session_get_loop(SessionHandle session);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_open(SessionHandle session, knurl_session_desc* desc);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_start(SessionHandle session, byte* warning, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_play(SessionHandle session, double* rows, ulong row_count, ulong ticks,
            double* forces, ulong* played);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_session_close(SessionHandle session);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_session_update(SessionHandle session);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_session_set_paused(SessionHandle session, uint paused);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_session_next_event(SessionHandle session, knurl_session_event* @event);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_session_fault_text(int code, double value, byte* text, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_session_get_state(SessionHandle session, knurl_session_state* state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_session_get_history(SessionHandle session, uint count, float* rows);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_move_hip(SessionHandle session, double* position);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_move_workspace(SessionHandle session, uint clock,
            knurl_workspace* workspace);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_set_clutch(SessionHandle session, uint on);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_set_gain(SessionHandle session, double gain);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_set_force(SessionHandle session, double* force);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_vibrate(SessionHandle session, int method, double frequency_hz,
            double amplitude, double* direction, double seconds);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_get_sound(SessionHandle session, double sample_rate_hz,
            knurl_sound** sound);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_sound_fill(knurl_sound* sound, float* samples, uint count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_sound_get_rumble(knurl_sound* sound, double* rumble);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_sound_release(knurl_sound* sound);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_tell_time(SessionHandle session, uint clock, double seconds);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int knurl_session_move_surface(SessionHandle session, ulong surface,
            knurl_session_way* way, double* position, double* rotation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_session_explain(SessionHandle session, ulong surface, byte* text, uint size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_session_split_pose(double* matrix, knurl_session_pose* pose);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_session_same_rest(double* a, double* b);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* knurl_unity_interface();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint knurl_unity_layout(uint index, knurl_unity_layout_row* row);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void knurl_unity_update(SessionHandle session);
    }
}
