// Test-only, never shipped: see Player.cs.
using System;
using System.Collections.Generic;
using System.Reflection;

namespace UnityEngine
{
    public static partial class Player
    {
        sealed class Kind
        {
            internal readonly Dictionary<string, MethodInfo> Methods = new Dictionary<string, MethodInfo>();
            internal readonly Dictionary<string, Action<object>> Calls = new Dictionary<string, Action<object>>();
            internal int Order;
            internal bool InEditMode;
        }

        const BindingFlags Any = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic |
                                 BindingFlags.DeclaredOnly;
        static readonly Dictionary<Type, Kind> kinds = new Dictionary<Type, Kind>();

        static Kind KindOf(Type type)
        {
            Kind kind;
            if (!kinds.TryGetValue(type, out kind))
            {
                kind = new Kind();
                object[] order = type.GetCustomAttributes(typeof(DefaultExecutionOrder), true);
                kind.Order = order.Length > 0 ? ((DefaultExecutionOrder)order[0]).order : 0;
                kind.InEditMode = type.IsDefined(typeof(ExecuteAlways), true) ||
                                  type.IsDefined(typeof(ExecuteInEditMode), true);
                kinds.Add(type, kind);
            }
            return kind;
        }

        static bool Runs(MonoBehaviour b) { return Application.isPlaying || KindOf(b.GetType()).InEditMode; }

        static MethodInfo Method(Kind kind, Type type, string name)
        {
            MethodInfo method;
            if (!kind.Methods.TryGetValue(name, out method))
            {
                for (Type t = type; t != null && method == null && t != typeof(Object); t = t.BaseType)
                {
                    method = t.GetMethod(name, Any);
                }
                kind.Methods.Add(name, method);
            }
            return method;
        }

        // Without allocation once a type is known, so that tests can count what a frame allocates.
        static Action<object> Call(Type type, string name)
        {
            Kind kind = KindOf(type);
            Action<object> call;
            if (!kind.Calls.TryGetValue(name, out call))
            {
                MethodInfo method = Method(kind, type, name);
                if (method != null)
                {
                    MethodInfo bind = typeof(Player).GetMethod("Bind", BindingFlags.Static | BindingFlags.NonPublic);
                    call = (Action<object>)bind.MakeGenericMethod(method.DeclaringType)
                        .Invoke(null, new object[] { method });
                }
                kind.Calls.Add(name, call);
            }
            return call;
        }

        static Action<object> Bind<T>(MethodInfo method) where T : class
        {
            Action<T> open = (Action<T>)Delegate.CreateDelegate(typeof(Action<T>), method);
            return target => open((T)target);
        }

        /// False if the method threw; true also if there is no method.
        internal static bool Send(Object target, string name)
        {
            try
            {
                Action<object> call = Call(target.GetType(), name);
                if (call != null)
                {
                    call(target);
                }
                return true;
            }
            catch (Exception e)
            {
                Debug.LogException(e, target);
                return false;
            }
        }

        static void Send(Object target, string name, object value)
        {
            MethodInfo method = Method(KindOf(target.GetType()), target.GetType(), name);
            if (method != null)
            {
                Guard(() => method.Invoke(target, new[] { value }), target);
            }
        }

        static void Guard(Action what, Object context)
        {
            try
            {
                what();
            }
            catch (TargetInvocationException e)
            {
                Debug.LogException(e.InnerException, context);
            }
            catch (Exception e)
            {
                Debug.LogException(e, context);
            }
        }

        static List<MonoBehaviour> InOrder()
        {
            List<MonoBehaviour> all = new List<MonoBehaviour>();
            Collect(all);
            return all;
        }

        static void Collect(List<MonoBehaviour> all)
        {
            all.Clear();
            for (int i = 0; i < objects.Count; i++)
            {
                List<Component> parts = objects[i].parts;
                for (int j = 0; j < parts.Count; j++)
                {
                    MonoBehaviour b = parts[j] as MonoBehaviour;
                    if ((object)b != null)
                    {
                        Insert(all, b);
                    }
                }
            }
        }

        // Stable: from behind, past those of a later order.
        static void Insert(List<MonoBehaviour> all, MonoBehaviour b)
        {
            int order = KindOf(b.GetType()).Order;
            int at = all.Count;
            while (at > 0 && KindOf(all[at - 1].GetType()).Order > order)
            {
                at--;
            }
            all.Insert(at, b);
        }

        static void Starts()
        {
            Collect(turn);
            for (int i = 0; i < turn.Count; i++)
            {
                if (turn[i].running && !turn[i].started)
                {
                    turn[i].started = true;
                    Send(turn[i], "Start");
                }
            }
        }

        static void ToAll(string name)
        {
            Collect(turn);
            for (int i = 0; i < turn.Count; i++)
            {
                MonoBehaviour b = turn[i];
                if (b.running && b.started && Runs(b))
                {
                    Send(b, name);
                }
            }
        }
    }
}
