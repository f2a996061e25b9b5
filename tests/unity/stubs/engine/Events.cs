// Test-only stand-ins, never shipped. Faithful: a listener's exception leaves Invoke and skips later ones; a listener
// added during a call is called from the next one on; those of a destroyed object are not called; a call allocates
// nothing. Not: listeners stored in a scene.
using System;
using System.Collections.Generic;

namespace UnityEngine.Events
{
    public delegate void UnityAction<T0>(T0 arg0);
    public delegate void UnityAction<T0, T1>(T0 arg0, T1 arg1);

    public abstract class UnityEventBase
    {
        readonly List<Delegate> listeners = new List<Delegate>();
        readonly List<Delegate> executing = new List<Delegate>(); // one for all calls, also for one inside of another
        bool isChanged;

        protected void Add(Delegate call) { listeners.Add(call); isChanged = true; }

        protected List<Delegate> Prepare()
        {
            if (isChanged)
            {
                executing.Clear();
                executing.AddRange(listeners);
                isChanged = false;
            }
            return executing;
        }

        protected static bool Allows(Delegate call)
        {
            var target = call.Target as Object;
            return ReferenceEquals(target, null) || target != null;
        }
    }

    [Serializable]
    public class UnityEvent<T0> : UnityEventBase
    {
        public void AddListener(UnityAction<T0> call) { Add(call); }
        public void Invoke(T0 arg0)
        {
            List<Delegate> calls = Prepare();
            for (int i = 0; i < calls.Count; i++)
            {
                if (Allows(calls[i]))
                {
                    ((UnityAction<T0>)calls[i])(arg0);
                }
            }
        }
    }

    [Serializable]
    public class UnityEvent<T0, T1> : UnityEventBase
    {
        public void AddListener(UnityAction<T0, T1> call) { Add(call); }
        public void Invoke(T0 arg0, T1 arg1)
        {
            List<Delegate> calls = Prepare();
            for (int i = 0; i < calls.Count; i++)
            {
                if (Allows(calls[i]))
                {
                    ((UnityAction<T0, T1>)calls[i])(arg0, arg1);
                }
            }
        }
    }
}
