#ifndef TREEFORM_TESTS_C_TEST_H
#define TREEFORM_TESTS_C_TEST_H
/* What the C tests share: checks that go on, small meshes, a folder to work in. */

#include <treeform.h>

#define CHECK(condition) check((condition) != 0, #condition, __FILE__, __LINE__)
/* The call succeeds; else its message is shown. */
#define OK(call) check_code((call), TREEFORM_OK, "", #call, __FILE__, __LINE__)
/* The call ends with this code, and the message contains these words. */
#define ENDS(code, words, call) check_code((call), (code), (words), #call, __FILE__, __LINE__)
#define INVALID(words, call) ENDS(TREEFORM_INVALID, words, call)

void check(int holds, const char* what, const char* file, int line);
void check_code(treeform_code got, treeform_code wanted, const char* words, const char* what,
                const char* file, int line);
int is(const char* a, const char* b);       /* equal strings */
int near(double a, double b);               /* to 1e-9 */
int stop(double done, void* calls);         /* a progress that stops at once, and counts */
const char* path_in_work(const char* name); /* of a file that the tests may write */

/* A cube with its lowest corner at x, y, z; a copy. */
treeform_mesh* cube(double x, double y, double z, double size);
/* A model of data/, ready for use. */
treeform_mesh* model(const char* path);
extern const double cube_points[24];
extern const uint32_t cube_faces[36];

void test_base(void);
void test_meshes(void);
void test_properties(void);
void test_cuts(void);
void test_shapes(void);
void test_files(void);
void test_attributes(void);
void test_intersections(void);
void test_search(void);
void test_solids(void);
void test_weld(void);
void test_streams(void);
void test_nearness(void);
void test_placement(void);
void test_layouts(void);
void test_assembly(void);
void test_trees(void);
void test_progress(void);

#endif
