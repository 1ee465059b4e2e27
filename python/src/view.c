/* Numbers of the library as a read-only buffer: numpy reads them without copying. */
#include "binding.h"

enum { MOST_DIMENSIONS = 3 };

typedef struct View {
  PyObject_HEAD PyObject *owner; /* keeps the numbers alive */
  const double *data;
  int ndim;
  Py_ssize_t shape[MOST_DIMENSIONS], strides[MOST_DIMENSIONS];
} View;

PyObject *view_new(State *state, PyObject *owner, const double *data, int ndim, const Py_ssize_t *shape,
                   const Py_ssize_t *strides) {
  View *view = PyObject_New(View, state->view);
  if (!view) return NULL;
  view->owner = Py_NewRef(owner);
  view->data = data;
  view->ndim = ndim;
  for (int i = 0; i < ndim; i++) {
    view->shape[i] = shape[i];
    view->strides[i] = strides[i];
  }
  return (PyObject *)view;
}

PyObject *view_of_rows(State *state, PyObject *owner, const double *data, size_t rows, size_t columns) {
  Py_ssize_t shape[] = {(Py_ssize_t)rows, (Py_ssize_t)columns};
  Py_ssize_t strides[] = {shape[1] * (Py_ssize_t)sizeof *data, sizeof *data};
  return view_new(state, owner, data, 2, shape, strides);
}

static int view_buffer(PyObject *self, Py_buffer *buffer, int flags) {
  View *view = (View *)self;
  if ((flags & PyBUF_WRITABLE) || (flags & PyBUF_STRIDES) != PyBUF_STRIDES) {
    PyErr_SetString(PyExc_BufferError, "results are read-only and may have strides");
    return -1;
  }
  Py_ssize_t count = 1;
  for (int i = 0; i < view->ndim; i++)
    count *= view->shape[i];
  *buffer = (Py_buffer){.buf = (void *)view->data,
                        .obj = Py_NewRef(self),
                        .len = count * (Py_ssize_t)sizeof(double),
                        .itemsize = sizeof(double),
                        .readonly = 1,
                        .ndim = view->ndim,
                        .format = (flags & PyBUF_FORMAT) ? "d" : NULL,
                        .shape = view->shape,
                        .strides = view->strides};
  return 0;
}

static void view_dealloc(PyObject *self) {
  Py_DECREF(((View *)self)->owner);
  free_object(self);
}

static PyType_Slot slots[] = {
    {Py_tp_doc, "Numbers of the library as a read-only buffer."},
    {Py_bf_getbuffer, view_buffer},
    {Py_tp_dealloc, view_dealloc},
    {0, NULL},
};
PyType_Spec view_spec = {"zipact._zipact.View", sizeof(View), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
                         slots};
