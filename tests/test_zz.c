#include "check_util.h"
#include "base/kernel.h"
#include "electro/edges.h"
TEST(zz) {
  ZpEdgeParams p = {.w = 20e-6, .b = 2e-6, .t = 0, .eps_m = 1, .eps_i = 1, .plate = true, .least=0.4e-6};
  for (int v=0; v<8; v++) {
    ZpFieldMesh mesh = zp_edges_mesh(&p);
    if (v&1) mesh.strip=8;
    if (v&2) mesh.clip=24, mesh.outside=32, mesh.gap=12;
    if (v&4) mesh.first/=4;
    double g[6]={4e-6,4.01e-6,3e-6,3.01e-6,1e-6,1.01e-6}, C[6];
    ck_assert(zp_edges_capacitance(&p,&mesh,6,g,C));
    printf("%d: ",v);
    for(int k=0;k<3;k++) printf(" %g: C/eps0 %.5f (%.5f) force ratio %.5f;", g[2*k]*1e6, C[2*k]/8.8541878128e-12, 20e-6/g[2*k], (C[2*k]-C[2*k+1])/8.8541878128e-12/(20e-6/g[2*k]-20e-6/g[2*k+1]));
    printf("\n");
  }
}
